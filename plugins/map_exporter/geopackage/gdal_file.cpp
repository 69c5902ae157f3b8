// SPDX-License-Identifier: BSD-3-Clause
#include "gdal_file.hpp"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include <mutex>

#include "cambium/error.hpp"
#include "common/iso_time.hpp"

namespace geopackage {

using namespace cambium;
using namespace map_export;

namespace {

/// GDAL prints what it dislikes; libraries of Cambium do not. Keeps the first failure.
void keep_first(CPLErr kind, CPLErrorNum, const char* message) {
  auto& first = *static_cast<std::string*>(CPLGetErrorHandlerUserData());
  if (kind >= CE_Failure && first.empty()) first = message;
}

/// For the calls of one member function: the handler belongs to the thread.
class Listening {
 public:
  explicit Listening(std::string& first) { CPLPushErrorHandlerEx(keep_first, &first); }
  ~Listening() { CPLPopErrorHandler(); }
};

/// An option of GDAL for this thread and scope.
class Option {
 public:
  Option(const char* key, const std::string& value) : key_(key) {
    CPLSetThreadLocalConfigOption(key, value.c_str());
  }
  ~Option() { CPLSetThreadLocalConfigOption(key_, nullptr); }

 private:
  const char* key_;
};

GDALDriverH driver() {
  static std::once_flag once;
  std::call_once(once, GDALAllRegister);
  return GDALGetDriverByName("GPKG");
}

OGRSpatialReferenceH reference(const System& system) {
  OGRSpatialReferenceH out = OSRNewSpatialReference(nullptr);
  OSRSetAxisMappingStrategy(out, OAMS_TRADITIONAL_GIS_ORDER);  // as Projection: east first
  const OGRErr error = system.crs.empty() ? OSRSetLocalCS(out, system.frame.c_str())
                                          : OSRSetFromUserInput(out, system.crs.c_str());
  if (error == OGRERR_NONE && system.crs.empty()) OSRSetLinearUnits(out, SRS_UL_METER, 1);
  if (error == OGRERR_NONE) return out;
  OSRDestroySpatialReference(out);
  throw Error(ErrorCode::config, "crs", "'" + system.crs + "' is not known to GDAL");
}

OGRFieldType type_of(const Field& field) {
  switch (field.type) {
    case FieldType::integer:
      return OFTInteger64;
    case FieldType::real:
      return OFTReal;
    case FieldType::time:
      return OFTDateTime;
    case FieldType::text:
      break;
  }
  return OFTString;
}

void set_value(OGRFeatureH feature, int i, const Value& value) {
  constexpr int utc = 100;
  if (const auto* whole = std::get_if<std::int64_t>(&value))
    OGR_F_SetFieldInteger64(feature, i, *whole);
  else if (const auto* number = std::get_if<double>(&value))
    OGR_F_SetFieldDouble(feature, i, *number);
  else if (const auto* text = std::get_if<std::string>(&value))
    OGR_F_SetFieldString(feature, i, text->c_str());
  else if (const auto* stamp = std::get_if<Stamp>(&value)) {
    const DateTime t = date_time(*stamp);
    OGR_F_SetFieldDateTimeEx(feature, i, t.year, t.month, t.day, t.hour, t.minute, float(t.second),
                             utc);
  }
}

OGRGeometryH geometry(bool line, const std::vector<Vec3>& points) {
  OGRGeometryH out = OGR_G_CreateGeometry(line ? wkbLineString25D : wkbPoint25D);
  for (const Vec3& p : points) OGR_G_AddPoint(out, p.x(), p.y(), p.z());
  // A line has two points, also that of a robot which stood still.
  if (line && points.size() == 1) OGR_G_AddPoint(out, points[0].x(), points[0].y(), points[0].z());
  return out;
}

}  // namespace

struct File::Handles {
  GDALDatasetH dataset = nullptr;
  OGRLayerH layer = nullptr;
  std::string first_failure;
  // The file has a temporary name and is synced by AtomicFile: SQLite need not journal.
  Option journal{"OGR_SQLITE_JOURNAL", "MEMORY"}, sync{"OGR_SQLITE_SYNCHRONOUS", "OFF"};
  Option now;
  explicit Handles(const Stamp& written) : now("OGR_CURRENT_DATE", iso_time(written)) {}
  ~Handles() {
    const Listening quiet(first_failure);
    if (dataset) GDALClose(dataset);
  }
};

File::File(const std::filesystem::path& path, const Stamp& written)
    : path_(path), file_(path), handles_(std::make_unique<Handles>(written)) {
  const Listening listening(handles_->first_failure);
  const GDALDriverH gpkg = driver();
  check(gpkg, "this GDAL has no driver GPKG");
  std::filesystem::remove(file_.temporary());  // GDAL wants to make the file itself
  handles_->dataset = GDALCreate(gpkg, file_.temporary().c_str(), 0, 0, 0, GDT_Unknown, nullptr);
  check(handles_->dataset, "cannot be written");
  check(GDALDatasetStartTransaction(handles_->dataset, false) == OGRERR_NONE, "cannot be written");
}

File::~File() = default;

void File::check(bool done, const char* what) {
  if (done && handles_->first_failure.empty()) return;
  throw Error(
      ErrorCode::data, path_.string(),
      std::string(what) + (handles_->first_failure.empty() ? "" : ": " + handles_->first_failure));
}

void File::begin_layer(const std::string& name, const Layer& layer, const System& system,
                       const std::string& description) {
  const Listening listening(handles_->first_failure);
  OGRSpatialReferenceH srs = reference(system);
  const std::string text = "DESCRIPTION=" + description;
  const char* options[] = {text.c_str(), nullptr};
  handles_->layer = GDALDatasetCreateLayer(handles_->dataset, name.c_str(), srs,
                                           layer.lines ? wkbLineString25D : wkbPoint25D,
                                           const_cast<char**>(options));
  OSRDestroySpatialReference(srs);
  check(handles_->layer, "cannot be written");
  for (const Field& field : layer.fields) {
    // `id` and `fid` are different things: GDAL counts fid by itself.
    OGRFieldDefnH definition = OGR_Fld_Create(field.name, type_of(field));
    const bool made = OGR_L_CreateField(handles_->layer, definition, false) == OGRERR_NONE;
    OGR_Fld_Destroy(definition);
    check(made, "cannot be written");
  }
}

void File::add(const Layer& layer, const std::vector<Vec3>& points,
               const std::vector<Value>& values) {
  const Listening listening(handles_->first_failure);
  OGRFeatureH feature = OGR_F_Create(OGR_L_GetLayerDefn(handles_->layer));
  for (std::size_t i = 0; i < values.size(); ++i) set_value(feature, int(i), values[i]);
  OGR_F_SetGeometryDirectly(feature, geometry(layer.lines, points));
  const bool added = OGR_L_CreateFeature(handles_->layer, feature) == OGRERR_NONE;
  OGR_F_Destroy(feature);
  check(added, "cannot be written");
}

void File::commit() {
  {
    const Listening listening(handles_->first_failure);
    const bool done = GDALDatasetCommitTransaction(handles_->dataset) == OGRERR_NONE;
    GDALClose(handles_->dataset);  // its extents and indices are written here; it may fail, too
    handles_->dataset = nullptr;
    check(done, "cannot be written");
  }
  file_.commit();
}

}  // namespace geopackage
