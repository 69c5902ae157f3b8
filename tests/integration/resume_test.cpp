// SPDX-License-Identifier: BSD-3-Clause
// A run that ends too early (killed, interrupted, disk full) and starts again writes the bytes of
// an undisturbed run and repeats no work item that was finished.
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <functional>
#include <map>
#include <random>
#include <thread>

#include "cambium/files.hpp"
#include "command.hpp"
#include "support/support.hpp"

using namespace cambium;
using namespace cambium::testing;
namespace fs = std::filesystem;

namespace {

constexpr const char* spec =
    "version: 1\nseed: 3\nstand: {size: [60, 50], density: 700}\n"
    "sensor: {beams: 12, columns: 240, max_range: 30}\npath: {kind: loop, size: [26, 14], spacing: "
    "3}\n"
    "missions: [{name: a}, {name: b, path: {offset: 1, reversed: true}}]\n";
constexpr const char* steps =
    "version: 1\nsteps:\n"
    "  - recognize: proximity\n    params: {radius: 6.0, candidates: 2}\n    min_path: 30\n"
    "  - register: gicp\n    params: {min_overlap: 0.2}\n  - verify: pairwise_consistency\n  - "
    "optimize: ceres\n"
    "  - recognize: scan_context\n    params: {candidates: 1}\n"
    "  - register: ndt\n    params: {min_overlap: 0.2}\n  - verify: "
    "pairwise_consistency\n  - optimize: ceres\n"
    "  - evaluate: ate\n  - export: plan\n  - export: cloud\n";

// What does not tell times: of report.json the metrics, of report.html all before its part "run".
std::string timeless(const fs::path& file) {
  if (file.filename() == "report.json") return read_json(file)["metrics"].dump();
  const std::string text = read_file(file);
  return file.filename() == "report.html" ? text.substr(0, text.find("id=\"run\"")) : text;
}

// Path below `folder` -> content.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> out;
  if (!fs::exists(folder)) return out;
  for (const auto& e : fs::recursive_directory_iterator(folder)) {
    if (!e.is_regular_file()) continue;
    out[fs::relative(e.path(), folder).string()] = timeless(e.path());
  }
  return out;
}

// Entry -> inode. An entry that is made again gets another inode, since it is renamed into place.
std::map<std::string, ino_t> entries(const fs::path& cache) {
  std::map<std::string, ino_t> out;
  if (!fs::exists(cache)) return out;
  for (const auto& e : fs::recursive_directory_iterator(cache)) {
    struct stat info {};
    if (!e.is_regular_file() || e.path().filename().string().starts_with(".tmp-")) continue;
    ::stat(e.path().c_str(), &info);
    out[fs::relative(e.path(), cache).string()] = info.st_ino;
  }
  return out;
}

std::function<void()> after(double seconds) {
  return [=] { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); };
}

class Resume : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    write_file(*folder_ / "spec.yaml", spec);
    write_file(*folder_ / "p.yaml", steps);
    const auto made = run_cambium({"simulate", path("spec.yaml"), path("missions"), "--quiet"});
    ASSERT_EQ(made.code, 0) << made.err;
    // The shorter of two, so that kills fall into the run however busy the machine is meanwhile.
    seconds_ = std::min(run_undisturbed("undisturbed"), run_undisturbed("undisturbed_again"));
    undisturbed_ = contents(path("undisturbed"));
    ASSERT_GT(undisturbed_.size(), 6u);
  }
  static void TearDownTestSuite() { delete folder_; }

  static std::string path(const std::string& name) { return (*folder_ / name).string(); }
  static std::vector<std::string> arguments(const std::string& name) {
    return {"run",      path("p.yaml"), path("missions/a"),    path("missions/b"), "--out",
            path(name), "--cache",      path(name + "_cache"), "--threads",        "2"};
  }

  static double run_undisturbed(const std::string& name) {
    const auto begin = std::chrono::steady_clock::now();
    const auto outcome = run_cambium(arguments(name));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  // What is in the folder of a run that ended early is whole: the bytes of the undisturbed run.
  void expect_nothing_half_written(const std::string& name) {
    for (const auto& [file, content] : contents(path(name)))
      EXPECT_TRUE(undisturbed_.at(file) == content) << name << "/" << file;
  }

  void expect_resumes(const std::string& name) {
    const auto before = entries(path(name + "_cache"));
    const auto again = run_cambium(arguments(name));
    ASSERT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(contents(path(name)), undisturbed_) << name;
    const auto after = entries(path(name + "_cache"));
    for (const auto& [entry, inode] : before)
      EXPECT_EQ(after.at(entry), inode) << entry << " was finished and made again";
    EXPECT_EQ(after.size(), entries(path("undisturbed_cache")).size());
  }

  inline static TemporaryFolder* folder_ = nullptr;
  inline static double seconds_ = 0;
  inline static std::map<std::string, std::string> undisturbed_;
};

}  // namespace

TEST_F(Resume, AfterKillsAtRandomMoments) {
  std::mt19937 random(20);
  std::uniform_real_distribution<double> moment(0, seconds_);
  int killed = 0;
  for (int i = 0; i < 20; ++i) {
    const std::string name = "killed_" + std::to_string(i);
    const auto first = run_cambium_interrupted(arguments(name), after(moment(random)), SIGKILL);
    killed += first.code == 128 + SIGKILL;
    expect_resumes(name);
  }
  EXPECT_GE(killed, 5) << "most runs ended before they could be killed";
}

TEST_F(Resume, AfterManyKillsOfTheSameRun) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> moment(0, seconds_ / 2);
  for (int i = 0; i < 6; ++i)
    run_cambium_interrupted(arguments("again"), after(moment(random)), SIGKILL);
  expect_resumes("again");
}

TEST_F(Resume, AfterCtrlC) {
  // Not after some time: how long a run takes to begin depends on the machine.
  const auto begun = [] {
    for (int i = 0; i < 60000 && entries(path("interrupted_cache")).empty(); ++i) after(0.001)();
  };
  const auto outcome = run_cambium_interrupted(arguments("interrupted"), begun, SIGINT);
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_NE(outcome.err.find("cancelled"), std::string::npos) << outcome.err;
  for (const auto& e : fs::recursive_directory_iterator(path("interrupted")))
    EXPECT_FALSE(e.path().filename().string().starts_with(".tmp-")) << e.path();
  expect_nothing_half_written("interrupted");
  expect_resumes("interrupted");
}

TEST_F(Resume, AfterAFullDisk) {
  for (const std::size_t largest : {600u, 2500u, 9000u, 30000u}) {
    const std::string name = "full_" + std::to_string(largest);
    auto quiet = arguments(name);
    quiet.push_back("--quiet");
    const auto outcome = run_cambium_on_full_disk(quiet, largest);
    EXPECT_EQ(outcome.code, 4) << outcome.err;
    EXPECT_NE(outcome.err.find("cannot be written: File too large"), std::string::npos)
        << outcome.err;
    expect_nothing_half_written(name);
    expect_resumes(name);
  }
}

TEST_F(Resume, DamagedEntriesAreComputedAgainWithAWarning) {
  ASSERT_EQ(run_cambium(arguments("damaged")).code, 0);
  const fs::path cache = path("damaged_cache");
  int damaged = 0;
  for (const auto& [entry, inode] : entries(cache)) {
    if (++damaged > 12) break;
    fs::resize_file(cache / entry, damaged % 2 ? fs::file_size(cache / entry) - 1 : 10);
  }
  const auto again = run_cambium(arguments("damaged"));
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.err.find("does not fit its digest"), std::string::npos) << again.err;
  EXPECT_EQ(contents(path("damaged")), undisturbed_);
  EXPECT_EQ(run_cambium({"cache", "verify", "--cache", cache.string()}).out, "0 damaged entries\n");
}

TEST_F(Resume, TwoRunsShareACache) {
  auto one = arguments("shared"), two = arguments("shared");
  one[5] = path("shared_one"), two[5] = path("shared_two");
  Outcome first;
  std::thread other([&] { first = run_cambium(one); });
  const auto second = run_cambium(two);
  other.join();
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(second.code, 0) << second.err;
  EXPECT_EQ(contents(path("shared_one")), undisturbed_);
  EXPECT_EQ(contents(path("shared_two")), undisturbed_);
}

TEST_F(Resume, ACacheMayBePrunedWhileItIsUsed) {
  Outcome outcome;
  std::atomic<bool> done{false};
  std::thread run([&] {
    outcome = run_cambium(arguments("pruned"));
    done = true;
  });
  while (!done)
    if (fs::exists(path("pruned_cache")))
      run_cambium({"cache", "prune", "--larger-than", "1K", "--cache", path("pruned_cache")});
  run.join();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(contents(path("pruned")), undisturbed_);
}
