// SPDX-License-Identifier: BSD-3-Clause
// The sections of a mission.
#include "simulate/spec.hpp"

namespace cambium::simulate {

void PathSpec::params(ParamVisitor& v) {
  v("kind", kind, "loop: an ellipse; lawn_mower: lanes to and fro; line; waypoints",
    one_of({"loop", "lawn_mower", "line", "waypoints"}));
  v("center", center, "East and north", in_unit("m"));
  v("size", size, "Length along the heading and width across it", between(0, 5000, "m"));
  v("waypoints", waypoints, "Of kind waypoints: x, y, x, y, ... about the center", in_unit("m"));
  v("heading", heading, "Turns the path, counter-clockwise from east", in_unit("deg"));
  v("offset", offset, "Moves the path to its left: parallel to another one", in_unit("m"));
  v("lanes", lanes, "Of kind lawn_mower", between(1, 1000));
  v("reversed", reversed, "Walk it from its end to its start");
  v("spacing", spacing, "Distance between nodes", between(0.1, 100, "m"));
  v("speed", speed, "Of the robot", between(0.05, 50, "m/s"));
  v("height", height, "Of the sensor above the ground", between(0.2, 500, "m"));
  v("level", level, "Fly at one altitude, 'height' above the mean ground, instead of following it");
}

std::string PathSpec::check_params() const {
  if (center.size() != 2) return "'center' must be two numbers, [east, north]";
  if (size.size() != 2) return "'size' must be two numbers, [length, width]";
  if (waypoints.size() % 2 != 0 || (kind == "waypoints" && waypoints.size() < 4))
    return "'waypoints' must be pairs of x and y, two or more";
  return {};
}

void SensorSpec::params(ParamVisitor& v) {
  v("clouds", clouds, "Write a point cloud for every node");
  v("labels", labels, "Write with each point whether it lies on ground, trunk, branch or leaf");
  v("beams", beams, "Of the spinning lidar: 16, 32, 64", between(1, 256));
  v("columns", columns, "Directions in one turn", between(8, 4096));
  v("lowest", lowest, "Elevation of the lowest beam", between(-90, 90, "deg"));
  v("highest", highest, "Elevation of the highest beam", between(-90, 90, "deg"));
  v("mount_pitch", mount_pitch,
    "Turns the lidar about the robot's y axis; 90 = it spins about the direction of travel, as "
    "under a UAV",
    between(-180, 180, "deg"));
  v("min_range", min_range, "Nearer returns are those of the robot itself", between(0, 10, "m"));
  v("max_range", max_range, "No return from farther away", between(1, 500, "m"));
  v("range_noise", range_noise, "Standard deviation", between(0, 1, "m"));
  v("sway", sway, "Standard deviation of roll and pitch of the robot", between(0, 20, "deg"));
}

std::string SensorSpec::check_params() const {
  if (highest < lowest) return "'highest' must not be below 'lowest'";
  return min_range < max_range ? "" : "'min_range' must be below 'max_range'";
}

void CameraSpec::params(ParamVisitor& v) {
  v("enabled", enabled, "Write a grey picture for every node, of what lies ahead");
  v("columns", columns, "Pixels across", between(16, 4096));
  v("rows", rows, "Pixels down", between(16, 4096));
  v("field_of_view", field_of_view, "From the left to the right border", between(10, 150, "deg"));
  v("noise", noise, "Standard deviation of a pixel, of 255", between(0, 100));
}

void OdometrySpec::params(ParamVisitor& v) {
  v("drift", drift, "Root mean square horizontal error after drift_length, as a share of it",
    between(0, 20, "%"));
  v("drift_length", drift_length, "Where drift is measured; it grows with the power 1.5",
    above(0, "m"));
  v("tilt", tilt, "Roll and pitch are observed anew at every node, with this standard deviation",
    between(0, 10, "deg"));
  v("sigma_position", sigma_position, "What the robot claims of an odometry edge", above(0, "m"));
  v("sigma_rotation", sigma_rotation, "What the robot claims of an odometry edge", above(0, "rad"));
}

void GnssSpec::params(ParamVisitor& v) {
  v("enabled", enabled, "Write gnss.csv");
  v("rate", rate, "Fixes a second", between(0.001, 100, "Hz"));
  v("sigma", sigma, "Standard deviation of east and north; under canopy 1 to 10",
    between(0.001, 100, "m"));
  v("vertical_factor", vertical_factor, "How much worse the altitude is", between(0.1, 10));
  v("correlation_time", correlation_time, "Of the errors, which are a Gauss-Markov process",
    between(0, 10000, "s"));
  v("jump_interval", jump_interval, "Mean time between two jumps of the altitude; 0 = none",
    at_least(0, "s"));
  v("jump_height", jump_height, "Standard deviation of a jump", at_least(0, "m"));
  v("jump_duration", jump_duration, "Mean time until a jump ends", above(0, "s"));
  v("outage_interval", outage_interval, "Mean time between two outages; 0 = none",
    at_least(0, "s"));
  v("outage_duration", outage_duration, "Mean duration of an outage", above(0, "s"));
}

void TreesSpec::params(ParamVisitor& v) {
  v("enabled", enabled, "Write a tree table for every node");
  v("max_range", max_range, "Nothing is detected farther away", between(5, 200, "m"));
  v("min_dbh", min_dbh, "Half of the stems of this diameter are reconstructed",
    between(0.01, 1, "m"));
  v("position_noise", position_noise, "Of a reconstructed base, east and north each",
    between(0, 1, "m"));
  v("height_noise", height_noise, "Of a reconstructed base, up", between(0, 5, "m"));
  v("dbh_noise", dbh_noise, "Of the diameter", between(0, 0.5, "m"));
  v("axis_noise", axis_noise, "Of the direction of a reconstructed stem, about two axes each",
    between(0, 30, "deg"));
  v("spurious", spurious, "Mean number of detections in a table where nothing stands",
    between(0, 500));
}

}  // namespace cambium::simulate
