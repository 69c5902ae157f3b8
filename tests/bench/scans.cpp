// SPDX-License-Identifier: BSD-3-Clause
// Scan-to-scan registration on real and simulated scans, beside its peers:
//   bench_scans [--global YAML] [--consecutive] [--strangers STRIDE] [--honesty PAIRS YAML SEED]
//               [--peers PYTHON]
// Without options: all but the peers. See docs/benchmarks.md.
#include "bench/scans.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "support/support.hpp"

namespace {

using namespace cambium;

int run_peers(const std::string& python) {
  const auto data = cambium::testing::real_data("missions_newer_college"),
             mulran = cambium::testing::real_data("scans_mulran");
  if (data.empty() || mulran.empty()) return 0;
  const auto script = std::filesystem::path(__FILE__).parent_path() / "scans_peer.py";
  const std::string command = "OMP_NUM_THREADS=1 '" + python + "' '" + script.string() + "' '" +
                              data.string() + "' '" + mulran.string() + "'";
  std::fflush(stdout);
  return std::system(command.c_str()) == 0 ? 0 : 1;
}

int run(int argc, char** argv) {
  const auto next = [&](int& i, const char* otherwise) {
    return std::string(i + 1 < argc && argv[i + 1][0] != '-' ? argv[++i] : otherwise);
  };
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--global")
      bench::global_table(next(i, "{}"));
    else if (option == "--consecutive")
      bench::consecutive_table();
    else if (option == "--strangers")
      bench::stranger_table("{}", std::stoul(next(i, "1")));
    else if (option == "--honesty") {
      const int pairs = std::stoi(next(i, "500"));
      const std::string yaml = next(i, "{}");
      bench::honesty_table(yaml, pairs, std::stoul(next(i, "5")));
    } else if (option == "--peers") {
      if (run_peers(next(i, "python3")) != 0) return 1;
    } else {
      return std::fprintf(stderr, "unknown option %s\n", argv[i]), 2;
    }
  }
  if (argc > 1) return 0;
  bench::global_table("{}");
  bench::consecutive_table();
  bench::stranger_table("{}", 1);
  bench::honesty_table("{}", 500);
  return 0;
}

}  // namespace

int main(int argc, char** argv) try { return run(argc, argv); } catch (const std::exception& e) {
  return std::fprintf(stderr, "%s\n", e.what()), 1;
}
