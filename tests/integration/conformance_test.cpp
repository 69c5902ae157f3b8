// SPDX-License-Identifier: BSD-3-Clause
// `cambium plugins check` finds what is wrong with a plugin, and says so.
#include "command.hpp"
#include "support/places.hpp"
#include "support/support.hpp"

using namespace cambium;
using namespace cambium::testing;

namespace {

const std::string lawless = built("tests/conformance/plugins/lawless.so").string();

struct Crime {
  const char *component, *law, *message;
  friend std::ostream& operator<<(std::ostream& out, const Crime& c) { return out << c.component; }
};

class Lawless : public ::testing::TestWithParam<Crime> {};

}  // namespace

TEST_P(Lawless, IsFoundOut) {
  const Outcome o = run_cambium({"plugins", "check", lawless, "--only", GetParam().component});
  EXPECT_EQ(o.code, 1) << o.out << o.err;
  const std::string line = std::string("BROKEN   ") + GetParam().law + ": ";
  const auto at = o.out.find(line);
  ASSERT_NE(at, std::string::npos) << o.out;
  EXPECT_NE(o.out.find(GetParam().message, at), std::string::npos) << o.out;
}

INSTANTIATE_TEST_SUITE_P(
    Components, Lawless,
    ::testing::Values(
        Crime{"undocumented", "documents its parameters", "parameter 'level' has the line '?'"},
        Crime{"out_of_bounds", "has defaults within its own bounds", "found 1"},
        Crime{"crashes", "bears no payload", "ended by signal 11"},
        Crime{"prints", "prints nothing", "printed 'filtering"},
        Crime{"stubborn", "ends within a second when cancelled", "context.check_cancelled()"},
        Crime{"counts_calls", "gives the same bytes twice", "hidden state"},
        Crime{"throws_other", "bears an empty cloud and table", "threw 'vector'"},
        Crime{"raises_cost", "gives a sound result", "raised the cost"},
        Crime{"believes_all", "accepts no loop that is metres off", "accepted"},
        Crime{"looks_ahead", "keeps its promise of yaw invariance", "yaw_invariant() is true"}));

TEST(PluginsCheck, ALawfulComponentPassesAndAllShowsEveryLaw) {
  const Outcome o = run_cambium({"plugins", "check", lawless, "--only", "lawful", "--all"});
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  EXPECT_NE(o.out.find("payload_filter lawful: 18 laws, 0 broken"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("ok       serves two calls at once"), std::string::npos) << o.out;
}

TEST(PluginsCheck, ALibraryThatDoesNotOpenIsNamed) {
  const Outcome o =
      run_cambium({"plugins", "check", built("tests/bad_plugins/libraries/no_symbol.so").string()});
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.out.find("BROKEN   opens in this host"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("cambium_plugin"), std::string::npos) << o.out;
}
