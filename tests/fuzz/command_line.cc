// A command line of any words, between line breaks, is read or refused, and so is every word of it as a key.

#include "shared/command_line.h"
#include "shared/input/visible.h"
#include "tests/fuzz/as_file.h"

#include <sstream>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream text(std::string(reinterpret_cast<const char*>(data), size));
  std::vector<std::string> words = {"program"};
  for (std::string word; std::getline(text, word);) words.push_back(word.substr(0, word.find('\0')));
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  const bool all = size % 2 == 0;
  return spall::test::only_refuses([&] {
    for (const std::string& word : words)
      for (const char c : spall::shortened(spall::visible(word)))
        if (static_cast<unsigned char>(c) < 0x20) std::abort(); // a terminal would obey it
    spall::parse_command_line(static_cast<int>(arguments.size()), arguments.data(),
                              {.restart = all, .force = true, .plan = all, .accuracy = all});
  });
}
