// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/run_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "matrix/datasets.hpp"
#include "matrix/job.hpp"

namespace cambium::matrix {
namespace {

// Starts jobs as threads become free and collects what they leave.
class Runner {
 public:
  Runner(const Spec& spec, std::vector<Job> jobs, const RunSettings& settings, const Engine& engine)
      : spec_(spec),
        jobs_(std::move(jobs)),
        settings_(settings),
        engine_(engine),
        schedule_(all_steps(jobs_)),
        most_(settings.jobs > 0 ? settings.jobs : std::size_t(engine.threads())),
        free_threads_(engine.threads()),
        runs_(jobs_.size()) {}

  std::vector<CellRun> run() {
    engine_.progress().begin("cells");
    engine_.progress().expect(jobs_.size());
    while (!schedule_.done()) {
      if (engine_.cancelled()) cancel();
      start_ready();
      wait();
      collect();
    }
    return std::move(runs_);
  }

 private:
  struct Running {
    std::unique_ptr<Child> child;
    int threads;
  };

  static std::vector<Steps> all_steps(const std::vector<Job>& jobs) {
    std::vector<Steps> out;
    for (const Job& job : jobs) out.push_back(job.steps);
    return out;
  }

  // What starts now shares the threads that are free: a cell that must run alone gets them all.
  void start_ready() {
    const auto ready = schedule_.ready(most_ - running_.size());
    for (std::size_t i = 0; i < ready.size(); ++i)
      start(ready[i], std::max(1, free_threads_ / int(ready.size() - i)));
  }

  void start(std::size_t job, int threads) {
    auto command = jobs_[job].command;
    command.insert(command.end(), {"--threads", std::to_string(threads), "--memory",
                                   std::to_string(settings_.engine.memory / most_)});
    running_[job] = {std::make_unique<Child>(command, jobs_[job].log, spec_.time_limit), threads};
    free_threads_ -= threads;
    schedule_.start(job);
  }

  // Wakes up at once when a child ends, and now and then for time limits and Ctrl-C.
  void wait() const {
    std::vector<int> descriptors;
    for (const auto& [job, r] : running_) descriptors.push_back(r.child->descriptor());
    wait_any(descriptors, 0.2);
  }

  void collect() {
    for (auto it = running_.begin(); it != running_.end();) {
      if (!it->second.child->ended()) {
        ++it;
        continue;
      }
      const std::size_t job = it->first;
      runs_[job] = read_job(jobs_[job], it->second.child->outcome());
      free_threads_ += it->second.threads;
      schedule_.finish(job);
      it = running_.erase(it);
      report(job);
    }
  }

  void report(std::size_t job) const {
    const CellRun& run = runs_[job];
    engine_.progress().advance();
    engine_.progress().log(
        run.status == Status::ok ? LogLevel::info : LogLevel::warning,
        fmt::format("{:<48} {:>8.2f} s  {}{}{}", jobs_[job].name, run.seconds,
                    to_string(run.status), run.message.empty() ? "" : ": ", run.message));
  }

  [[noreturn]] void cancel() {
    for (auto& [job, r] : running_) r.child->stop();
    for (auto& [job, r] : running_)
      while (!r.child->ended()) wait_any({r.child->descriptor()}, 0.2);
    throw Cancelled();
  }

  const Spec& spec_;
  std::vector<Job> jobs_;
  const RunSettings& settings_;
  const Engine& engine_;
  Schedule schedule_;
  std::size_t most_;
  int free_threads_;
  std::map<std::size_t, Running> running_;
  std::vector<CellRun> runs_;
};

// Missions by dataset; those of a dataset that is not there are empty.
std::map<std::string, std::vector<std::string>> prepare_all(const Spec& spec,
                                                            const RunSettings& settings,
                                                            const Engine& engine) {
  std::map<std::string, std::vector<std::string>> out;
  for (const Dataset& d : spec.datasets) {
    const auto context = engine.context(digest_bytes(d.name), 0);
    out[d.name] = prepare(d, settings.out / "datasets" / d.name, *context);
    if (out[d.name].empty())
      context->warn(fmt::format("the dataset '{}' is not there; its cells are left out", d.name));
  }
  return out;
}

}  // namespace

std::vector<CellResult> run_cells(const Spec& spec, const std::vector<Cell>& cells,
                                  const RunSettings& settings, const Engine& engine) {
  std::filesystem::create_directories(settings.out / "cells");
  const auto missions = prepare_all(spec, settings, engine);
  std::vector<CellResult> results;
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    results.push_back({cells[i].name, cells[i].choices, {}});
    const auto& of_dataset = missions.at(results[i].dataset());
    if (of_dataset.empty())
      results[i].runs.push_back({0, Status::absent, "the dataset is not there", 0, {}});
    for (int k = 0; k < spec.repeat && !of_dataset.empty(); ++k)
      jobs.push_back(make_job(cells[i], i, of_dataset,
                              cells[i].pipeline.spec.seed + std::uint64_t(k), settings));
  }
  const auto runs = Runner(spec, jobs, settings, engine).run();
  for (std::size_t j = 0; j < jobs.size(); ++j) results[jobs[j].cell].runs.push_back(runs[j]);
  return results;
}

}  // namespace cambium::matrix
