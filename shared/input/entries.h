#pragma once

#include "shared/input/parameters.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace spall {

/// One key of an input.
struct Entry {
  std::string section, key;
  std::optional<std::string> value; ///< as text; none: has none
  std::string allowed, help;
  /// Checks and stores a value. @throws std::invalid_argument if it is bad
  std::function<void(const std::string&)> assign;
  std::vector<std::string> choices{};   ///< the words that it takes, if it takes words
  Needed needed{};                      ///< when there must be a value
  bool given = false;                   ///< whether it has been set
  const std::string* path_of = nullptr; ///< of the key of a file: the variable with its whole path

  std::string path() const { return section + "/" + key; }
};

/// All keys of an input, and their messages. In these, `where` names the source: file and line, or the word
/// of the command line.
struct Entries {
  std::vector<Entry> list; ///< in the order of their declaration

  /// @throws std::logic_error: the key is there already
  Entry& declare(Entry entry);
  /// Null if there is no such key.
  const Entry* find(const std::string& section, const std::string& key) const;
  /// Refuses a section that has no keys. @throws InputError
  void check_section(const std::string& path, const std::string& where) const;
  /// Sets one key. @throws InputError: it is unknown, or the value is refused
  void set(const std::string& section, const std::string& key, const std::string& value,
           const std::string& where);
  /// Returns the section that `path` and a key of the command line refer to: the section `path` itself, or
  /// the only one that ends with it; if several do, the only one that the file opens.
  /// @throws InputError: several fit. It names `word`
  std::string section_of(const std::string& path, const std::string& key, const std::string& word,
                         const std::vector<InputText::Opening>& openings) const;
  /// Says which keys with their sections a key without one may stand for, or "".
  std::string with_sections(const std::string& key) const;
  /// All values in the form of an input file.
  std::string text() const { return text_of("", 0); }

private:
  std::string text_of(const std::string& section, int depth) const;
  std::string nearest(const std::string& key, const std::string& section) const;
};

} // namespace spall
