// SPDX-License-Identifier: BSD-3-Clause
// What a simulation consists of. Every section declares its keys in params(), so that binding,
// bounds, messages and the JSON Schema come from one place. Lengths in metres; angles in degrees,
// as people write them; the code converts where it reads them.
#pragma once
#include <string>
#include <vector>

#include "cambium/kinds.hpp"

namespace cambium::simulate {

struct TerrainSpec : Component {
  double max_slope = 10, wavelength = 60, roughness = 0.03;
  void params(ParamVisitor& v) override;
};

struct StandSpec : Component {
  std::vector<double> size{100, 100};
  std::string pattern = "matern";
  double density = 940, hard_core = 1.1, jitter = 0, cluster_radius = 4, cluster_size = 8;
  double dbh_mean = 0.166, dbh_sd = 0.094, dominance = 2.8;
  double naslund_a = 1.2, naslund_b = 0.19, height_sd = 1;
  double lean = 2;
  std::vector<double> clearings;
  void params(ParamVisitor& v) override;
  std::string check_params() const override;
};

struct FoliageSpec : Component {
  double extinction = 0.25, crown_base = 0.5, crown_radius = 1.4, clumping = 0.6;
  double understory = 0.02, understory_height = 1;
  void params(ParamVisitor& v) override;
};

struct ClutterSpec : Component {
  double density = 250, lean = 12, max_height = 3;
  void params(ParamVisitor& v) override;
};

struct LoopsSpec : Component {
  double max_baseline = 40, min_overlap = 0.1;
  int min_gap = 10;
  void params(ParamVisitor& v) override;
};

struct PathSpec : Component {
  std::string kind = "loop";
  std::vector<double> center{0, 0}, size{40, 30}, waypoints;
  double heading = 0, offset = 0, spacing = 2, speed = 1, height = 1.6;
  int lanes = 3;
  bool reversed = false, level = false;
  void params(ParamVisitor& v) override;
  std::string check_params() const override;
};

struct SensorSpec : Component {
  bool clouds = true, labels = false;
  int beams = 32, columns = 1024;
  double lowest = -22.5, highest = 22.5, mount_pitch = 0;
  double min_range = 0.7, max_range = 60, range_noise = 0.02, sway = 2;
  void params(ParamVisitor& v) override;
  std::string check_params() const override;
};

struct CameraSpec : Component {
  bool enabled = false;
  int columns = 320, rows = 240;
  double field_of_view = 90, noise = 3;
  void params(ParamVisitor& v) override;
};

struct OdometrySpec : Component {
  double drift = 0.5, drift_length = 100, tilt = 0.3;
  double sigma_position = 0.05, sigma_rotation = 0.01;
  void params(ParamVisitor& v) override;
};

struct GnssSpec : Component {
  bool enabled = false;
  double rate = 1, sigma = 3, vertical_factor = 1.8, correlation_time = 60;
  double jump_interval = 0, jump_height = 12, jump_duration = 20;
  double outage_interval = 0, outage_duration = 30;
  void params(ParamVisitor& v) override;
};

struct TreesSpec : Component {
  bool enabled = false;
  double max_range = 32, min_dbh = 0.18, position_noise = 0.025, height_noise = 0.25;
  double dbh_noise = 0.035, axis_noise = 5, spurious = 12;
  void params(ParamVisitor& v) override;
};

/// One robot's recording, and what went wrong with it.
struct MissionSpec : Component {
  std::string name;
  int platform = 0;
  std::int64_t start = 0;  ///< 0: one hour after the mission before
  double harvested = 0, growth = 0, gravity_tilt = 0;
  int duplicate_stamps = 0, carried_at = 0;
  std::vector<double> carried_by{0, 0};
  void params(ParamVisitor& v) override;
  std::string check_params() const override;

  PathSpec path;
  SensorSpec sensor;
  CameraSpec camera;
  OdometrySpec odometry;
  GnssSpec gnss;
  TreesSpec trees;
};

struct SimulationSpec : Component {
  std::int64_t seed = 1;
  double latitude = 61.2, longitude = 25.1, altitude = 150;  ///< of the world's origin, WGS 84
  void params(ParamVisitor& v) override;

  TerrainSpec terrain;
  StandSpec stand;
  FoliageSpec foliage;
  ClutterSpec clutter;
  LoopsSpec loops;
  std::vector<MissionSpec> missions;
};

}  // namespace cambium::simulate
