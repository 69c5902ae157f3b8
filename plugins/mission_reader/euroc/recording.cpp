// SPDX-License-Identifier: BSD-3-Clause
#include "recording.hpp"

#include "cambium/error.hpp"
#include "common/csv_table.hpp"

namespace euroc {

using namespace cambium;
namespace fs = std::filesystem;

namespace {

constexpr std::int64_t second = 1'000'000'000;

/// The columns are told by their place: their names differ between recordings.
class Rows {
 public:
  Rows(const fs::path& table, std::size_t least, const char* what) : table_(table) {
    if (table_.columns().size() < least)
      throw Error(ErrorCode::data, table.string() + ":1",
                  "expected " + std::to_string(least) + " columns or more (" + what + "), found " +
                      std::to_string(table_.columns().size()));
  }
  std::size_t size() const { return table_.rows(); }
  double number(std::size_t row, std::size_t column) const {
    return table_.number(row, table_.columns()[column]);
  }
  Vec3 vector(std::size_t row, std::size_t column) const {
    return {number(row, column), number(row, column + 1), number(row, column + 2)};
  }
  const std::string& text(std::size_t row, std::size_t column) const {
    return table_.text(row, table_.columns()[column]);
  }
  /// Ascends from row to row.
  std::int64_t stamp(std::size_t row) {
    const std::int64_t out = table_.integer(row, table_.columns()[0]);
    if (row > 0 && out <= last_) table_.fail(row, "its stamp is not after that of the row before");
    return last_ = out;
  }
  [[noreturn]] void fail(std::size_t row, const std::string& what) const { table_.fail(row, what); }

 private:
  CsvTable table_;
  std::int64_t last_ = 0;
};

}  // namespace

std::int64_t nanoseconds(const Stamp& stamp) { return stamp.sec * second + stamp.nsec; }

Stamp stamp_of(std::int64_t nanoseconds) {
  return {nanoseconds / second, std::int32_t(nanoseconds % second)};
}

std::vector<TimedPose> read_poses(const fs::path& table) {
  Rows rows(table, 8, "timestamp, position x y z, quaternion w x y z");
  std::vector<TimedPose> out;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Quat q(rows.number(i, 4), rows.number(i, 5), rows.number(i, 6), rows.number(i, 7));
    if (q.norm() < 0.5) rows.fail(i, "its quaternion (columns 5 to 8) has no length");
    out.push_back({stamp_of(rows.stamp(i)), {q.normalized(), rows.vector(i, 1)}});
  }
  if (out.empty()) throw Error(ErrorCode::data, table.string(), "has no pose");
  return out;
}

std::vector<ImuSample> read_imu(const fs::path& table) {
  Rows rows(table, 7, "timestamp, angular velocity x y z, acceleration x y z");
  std::vector<ImuSample> out;
  for (std::size_t i = 0; i < rows.size(); ++i)
    out.push_back({rows.stamp(i), rows.vector(i, 1), rows.vector(i, 4)});
  return out;
}

std::map<std::int64_t, fs::path> read_frames(const fs::path& table,
                                             std::vector<std::string>& missing) {
  Rows rows(table, 2, "timestamp, file name");
  std::map<std::int64_t, fs::path> out;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const fs::path file = table.parent_path() / "data" / rows.text(i, 1);
    if (fs::is_regular_file(file))
      out.emplace(rows.stamp(i), file);
    else
      missing.push_back(rows.text(i, 1));
  }
  return out;
}

Payload NodePayload::load() const {
  Payload out;
  if (!images_.empty()) out.images = std::make_shared<const std::vector<Image>>(images_);
  if (begin_ < end_)
    out.imu = std::make_shared<const std::vector<ImuSample>>(all_->begin() + std::ptrdiff_t(begin_),
                                                             all_->begin() + std::ptrdiff_t(end_));
  return out;
}

Digest NodePayload::digest() const {
  Hasher hasher;
  hasher.add("euroc node 1");
  // Not the pictures' content: nothing is computed from it, and reading thousands takes long.
  for (const Image& image : images_)
    hasher.add(image.camera)
        .add(image.file.filename().string())
        .add(std::uint64_t(fs::file_size(image.file)));
  for (std::size_t i = begin_; i < end_; ++i) {
    hasher.add(std::uint64_t((*all_)[i].stamp));
    for (const double v : (*all_)[i].angular_velocity) hasher.add(v);
    for (const double v : (*all_)[i].acceleration) hasher.add(v);
  }
  return hasher.digest();
}

}  // namespace euroc
