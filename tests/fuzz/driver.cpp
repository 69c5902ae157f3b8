// SPDX-License-Identifier: BSD-3-Clause
// A small mutation fuzzer, for compilers without libFuzzer: driver COUNT SEED_FILE...
// The same count and files give the same inputs everywhere. On a violation the input that caused it
// is left in ./fuzz-crash.
#include <csignal>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "cambium/files.hpp"
#include "fuzz.hpp"

namespace {

// std::uniform_int_distribution differs between libraries; this does not.
class Dice {
 public:
  std::size_t below(std::size_t n) { return n == 0 ? 0 : engine_() % n; }

 private:
  std::mt19937_64 engine_{20260101};
};

std::string current_input;

extern "C" void keep_input(int) {
  if (std::FILE* out = std::fopen("fuzz-crash", "wb")) {
    std::fwrite(current_input.data(), 1, current_input.size(), out);
    std::fclose(out);
  }
  std::_Exit(1);
}

/// Words that parsers stumble over.
const char* const words[] = {"nan",
                             "-inf",
                             "1e999",
                             "1e-400",
                             "-0",
                             "0,5",
                             "#",
                             "FIX ",
                             "\r\n",
                             "\n",
                             "9223372036854775808",
                             "-1",
                             " ",
                             "\t",
                             "0",
                             "1e5",
                             "\xEF\xBB\xBF",
                             "EDGE_SE3_PRIOR 0 0",
                             "VERTEX_SE2"};

void mutate_bytes(std::string& text, Dice& dice) {
  const std::size_t at = dice.below(text.size());
  switch (dice.below(4)) {
    case 0:
      text[at] = char(dice.below(256));
      break;
    case 1:
      text.erase(at, 1 + dice.below(16));
      break;
    case 2:
      text.insert(at, words[dice.below(std::size(words))]);
      break;
    case 3:
      text.resize(at);
      break;
  }
}

/// Lines are what the formats are made of: swap, repeat, drop, or take one of another seed.
void mutate_lines(std::string& text, const std::string& other, Dice& dice) {
  const auto line_at = [](const std::string& from, std::size_t at) {
    const std::size_t begin = at == 0 ? 0 : from.rfind('\n', at - 1) + 1;  // npos + 1 = 0
    return std::pair(begin, std::min(from.find('\n', begin), from.size() - 1) + 1 - begin);
  };
  const auto [begin, length] = line_at(text, dice.below(text.size()));
  const std::string line = text.substr(begin, length);
  switch (dice.below(3)) {
    case 0:
      text.erase(begin, length);
      break;
    case 1:
      text.insert(line_at(text, dice.below(text.size())).first, line);
      break;
    case 2:
      if (other.empty()) break;
      const auto [from, size] = line_at(other, dice.below(other.size()));
      text.insert(begin, other, from, size);
      break;
  }
}

std::string mutant(const std::vector<std::string>& seeds, Dice& dice) {
  std::string text = seeds[dice.below(seeds.size())];
  for (std::size_t n = dice.below(5); n > 0 && !text.empty(); --n) {
    if (dice.below(2) == 0)
      mutate_bytes(text, dice);
    else
      mutate_lines(text, seeds[dice.below(seeds.size())], dice);
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: %s COUNT SEED_FILE...\n", argv[0]);
    return 2;
  }
  std::vector<std::string> seeds;
  for (int i = 2; i < argc; ++i) seeds.push_back(cambium::read_file(argv[i]));
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE}) std::signal(signal, &keep_input);
  Dice dice;
  for (long n = std::atol(argv[1]); n > 0; --n) {
    current_input = mutant(seeds, dice);
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(current_input.data()),
                           current_input.size());
  }
  std::printf("%s inputs, none violated a property\n", argv[1]);
  return 0;
}
