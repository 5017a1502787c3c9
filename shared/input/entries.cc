#include "shared/input/entries.h"

#include "shared/error.h"
#include "shared/input/words.h"
#include "shared/nearest.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace spall {
namespace {

/// How resolved inputs of earlier versions show a key without a value.
const char* const unset = "REQUIRED";

/// What may have been meant by a value that is refused, or "".
std::string hint(const Entry& entry, const std::string& value) {
  if (!entry.choices.empty()) {
    for (const std::string& word : split(value))
      if (std::find(entry.choices.begin(), entry.choices.end(), word) == entry.choices.end())
        return did_you_mean(word, entry.choices);
    return "";
  }
  if (value.find('#') != std::string::npos) return " (a comment begins with a blank and #)";
  return has_decimal_comma(value) ? " (a number has a decimal point, no comma)" : "";
}

/// Names of all sections, each without those around it.
std::vector<std::string> names_of_sections(const std::vector<Entry>& entries) {
  std::vector<std::string> names;
  for (const Entry& entry : entries)
    for (const std::string& name : split(entry.section, '/')) names.push_back(name);
  return names;
}

} // namespace

Entry& Entries::declare(Entry entry) {
  if (find(entry.section, entry.key) != nullptr)
    throw std::logic_error("the key '" + entry.path() + "' is declared twice");
  return list.emplace_back(std::move(entry));
}

const Entry* Entries::find(const std::string& section, const std::string& key) const {
  const auto found = std::find_if(list.begin(), list.end(), [&](const Entry& entry) {
    return entry.key == key && entry.section == section;
  });
  return found == list.end() ? nullptr : &*found;
}

void Entries::check_section(const std::string& path, const std::string& where) const {
  std::string outer;
  for (const std::string& name : split(path, '/')) {
    const std::string around = outer.empty() ? "" : " inside '" + outer + "'";
    outer += (outer.empty() ? "" : "/") + name;
    if (std::none_of(list.begin(), list.end(),
                     [&](const Entry& e) { return (e.section + "/").starts_with(outer + "/"); }))
      throw InputError(where + ": unknown subsection '" + name + "'" + around +
                       did_you_mean(name, names_of_sections(list)));
  }
}

void Entries::set(const std::string& section, const std::string& key, const std::string& value,
                  const std::string& where) {
  check_section(section, where);
  const Entry* found = find(section, key);
  if (found == nullptr) throw InputError(where + ": unknown key '" + key + "'" + nearest(key, section));
  Entry& entry = list[static_cast<std::size_t>(found - list.data())];
  if (!entry.value && value == unset) return;
  try {
    entry.assign(value);
  } catch (const std::invalid_argument&) {
    throw InputError(where + ": key '" + key + "': found '" + value + "', allowed: " + entry.allowed +
                     hint(entry, value));
  }
  entry.value = value;
  entry.given = true;
}

/// Returns " (did you mean 'Section/Key'?)" for a misspelt key; of equally near ones, that of its section.
std::string Entries::nearest(const std::string& key, const std::string& section) const {
  std::vector<std::string> keys;
  for (const Entry& entry : list) keys.push_back(entry.key);
  const std::size_t place = nearest_of(key, keys);
  if (place == keys.size()) return "";
  return " (did you mean '" +
         (find(section, keys[place]) ? section + "/" + keys[place] : list[place].path()) + "'?)";
}

std::string Entries::with_sections(const std::string& key) const {
  std::vector<std::string> paths;
  for (const Entry& entry : list)
    if (lower_case(entry.key) == lower_case(key)) paths.push_back(entry.path());
  return paths.empty() ? nearest(key, "") : " (did you mean '" + joined(paths, "' or '") + "'?)";
}

std::string Entries::section_of(const std::string& path, const std::string& key, const std::string& word,
                                const std::vector<InputText::Opening>& openings) const {
  std::vector<std::string> found, opened;
  for (const Entry& entry : list) {
    if (entry.section == path) return path;
    if (entry.key == key && entry.section.ends_with("/" + path)) found.push_back(entry.section);
  }
  for (const std::string& section : found)
    if (std::any_of(openings.begin(), openings.end(), [&](const auto& o) { return o.path == section; }))
      opened.push_back(section);
  if (!opened.empty()) found = opened;
  if (found.size() < 2) return found.empty() ? path : found.front();
  for (std::string& section : found) section += "/" + key;
  throw InputError("command line: '" + word + "' could mean " + joined(found, ", "));
}

/// What is set in a section and in those inside it, in the order of their declaration.
std::string Entries::text_of(const std::string& section, int depth) const {
  const std::string indent(2 * static_cast<std::size_t>(depth), ' ');
  std::vector<std::pair<std::string, std::string>> keys;
  std::vector<std::string> inside;
  std::size_t width = 0;
  for (const Entry& entry : list) {
    if (entry.section == section) {
      if (!entry.value) continue;
      keys.emplace_back(entry.key,
                        quoted_if_needed(entry.path_of != nullptr ? *entry.path_of : *entry.value));
      width = std::max(width, entry.key.size());
    } else if (section.empty() || entry.section.starts_with(section + "/")) {
      const std::string rest = entry.section.substr(section.empty() ? 0 : section.size() + 1),
                        name = rest.substr(0, rest.find('/'));
      if (std::find(inside.begin(), inside.end(), name) == inside.end()) inside.push_back(name);
    }
  }
  std::string text;
  for (auto& [key, set] : keys) {
    key.resize(width, ' ');
    text += indent + "set " + key + " = " + set + "\n";
  }
  for (const std::string& name : inside) {
    const std::string below = text_of(section.empty() ? name : section + "/" + name, depth + 1);
    if (!below.empty()) text += indent + "subsection " + name + "\n" + below + indent + "end\n";
  }
  return text;
}

} // namespace spall
