// SPDX-License-Identifier: BSD-3-Clause
#include "common/near_guess.hpp"

#include "common/search.hpp"

namespace cambium::registration {

void NearGuess::params(ParamVisitor& v) {
  CoarseToFine::params(v);
  v("search_radius", search_radius_,
    "Starts are searched in this horizontal distance around the guess; 0 = start at the guess",
    between(0.0, 100.0, "m"));
  v("search_height", search_height_, "Starts are searched this far up and down",
    between(0.0, 20.0, "m"));
  v("search_yaw", search_yaw_, "Starts are searched this far to either side of the guess's yaw",
    between(0.0, 3.15, "rad"));
  v("search_step", search_step_, "Grid of the search", above(0.0, "m"));
  v("hypotheses", hypotheses_, "How many distinct starts are refined", between(1, 100));
}

std::vector<SE3> NearGuess::starts(const PreparedCloud& target, const PreparedCloud& source,
                                   const SE3& guess) const {
  const SearchWindow window{search_radius_, search_height_, search_yaw_,
                            search_step_,   0.05,           hypotheses_};
  return search(target.coarse.surface, source.coarse.sample, guess, window);
}

}  // namespace cambium::registration
