// SPDX-License-Identifier: BSD-3-Clause
// Places as users write them, and where they lie in a map.
#include <cmath>

#include "cambium/files.hpp"
#include "cambium/projection.hpp"
#include "monitor/place.hpp"
#include "support/support.hpp"

namespace cambium::monitor {
namespace {

const GeoReference evo{61.2, 25.1, 130, SE3::from_yaw(0.4, {10, 20, 3}), 0, 0};

Vec3 in_map(double east, double north) { return evo.T_map_enu * Vec3(east, north, 0); }

std::string at(const Geodetic& g) {
  return std::to_string(g.latitude) + "," + std::to_string(g.longitude);
}

Geodetic enu(double east, double north) { return from_enu({61.2, 25.1, 130}, {east, north, 0}); }

TEST(Place, ACircleIsRoundOnTheGround) {
  PlaceOptions o;
  o.at = "61.2,25.1";
  o.radius = "15m";
  const Region region(parse_place(o), evo);
  EXPECT_TRUE(region.contains(in_map(0, 0)));
  for (double angle = 0; angle < 6.3; angle += 0.1) {
    EXPECT_TRUE(region.contains(in_map(14.99 * std::cos(angle), 14.99 * std::sin(angle))));
    EXPECT_FALSE(region.contains(in_map(15.01 * std::cos(angle), 15.01 * std::sin(angle))));
  }
  EXPECT_NEAR(region.distance(in_map(0, 40)), 25, 1e-6);
  EXPECT_FALSE(region.contains({NAN, 0, 0}));
}

// The same place in three systems.
TEST(Place, SystemsAgree) {
  const Projection utm("EPSG:32635");
  const Geodetic low = enu(-20, -10), high = enu(20, 10);
  const Vec3 p = utm(low), q = utm(high);
  PlaceOptions degrees, plane;
  degrees.box = at(low) + "," + at(high);
  plane.box = std::to_string(p.x()) + "," + std::to_string(p.y()) + "," + std::to_string(q.x()) +
              "," + std::to_string(q.y());
  plane.epsg = "32635";
  const Region a(parse_place(degrees), evo), b(parse_place(plane), evo);
  for (const auto& [east, north, inside] : std::vector<std::tuple<double, double, bool>>{
           {0, 0, true}, {18, 8, true}, {-18, -8, true}, {23, 0, false}, {0, 13, false}}) {
    EXPECT_EQ(a.contains(in_map(east, north)), inside) << east << " " << north;
    EXPECT_EQ(b.contains(in_map(east, north)), inside) << east << " " << north;
  }
}

TEST(Place, PolygonsHaveHoles) {
  const testing::TemporaryFolder folder;
  const auto ring = [](double r) {
    std::string out = "[";
    for (const auto& [x, y] :
         std::vector<std::pair<double, double>>{{-r, -r}, {r, -r}, {r, r}, {-r, r}, {-r, -r}}) {
      const Geodetic g = enu(x, y);
      out += (out.size() > 1 ? ",[" : "[") + std::to_string(g.longitude) + "," +
             std::to_string(g.latitude) + "]";
    }
    return out + "]";
  };
  write_file(
      folder / "p.geojson",
      "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\"properties\":{},"
      "\"geometry\":{\"type\":\"Polygon\",\"coordinates\":[" +
          ring(20) + "," + ring(5) + "]}}]}");
  PlaceOptions o;
  o.polygon = (folder / "p.geojson").string();
  const Region region(parse_place(o), evo);
  EXPECT_TRUE(region.contains(in_map(10, 10)));
  EXPECT_FALSE(region.contains(in_map(0, 0)));
  EXPECT_FALSE(region.contains(in_map(21, 0)));
}

std::string refusal(const PlaceOptions& o) {
  try {
    parse_place(o);
  } catch (const Error& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Place, MistakesSayWhatWasExpected) {
  const auto expect = [](const PlaceOptions& o, const std::string& part) {
    EXPECT_NE(refusal(o).find(part), std::string::npos) << refusal(o);
  };
  expect({}, "expected one place");
  expect({.at = "61,25", .radius = "5", .box = "1,2,3,4"}, "expected one place");
  expect({.at = "61,25"}, "belong together");
  expect({.at = "61", .radius = "5m"}, "--at: expected LAT,LON");
  expect({.at = "61,east", .radius = "5m"}, "--at");
  expect({.at = "61,25", .radius = "5 miles"}, "--radius: expected a length");
  expect({.at = "61,25", .radius = "-5"}, "--radius");
  expect({.at = "398000,6786000", .radius = "5m"}, "--epsg");
  expect({.at = "61,25", .radius = "5m", .epsg = "999999"}, "PROJ knows no");
  expect({.box = "61,25,61,26"}, "differ in both");
  const testing::TemporaryFolder folder;
  const auto file = [&](const std::string& text) {
    write_file(folder / "p.geojson", text);
    return PlaceOptions{.polygon = (folder / "p.geojson").string()};
  };
  expect(file("{"), "is no GeoJSON with polygons");
  expect(file("{\"type\":\"Point\",\"coordinates\":[25,61]}"), "found a Point");
  expect(file("{\"type\":\"FeatureCollection\",\"features\":[]}"), "holds no polygon");
  expect(file("{\"type\":\"Polygon\",\"coordinates\":[[[25,61],[26,61],[26,62]]]}"), "4 or more");
  expect(PlaceOptions{.polygon = (folder / "absent").string()}, "absent");
}

}  // namespace
}  // namespace cambium::monitor
