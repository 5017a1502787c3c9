#include "shared/input/parameters.h"

#include "shared/error.h"
#include "shared/input/patterns.h"
#include "shared/nearest.h"

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <regex>
#include <sstream>

namespace spall {
namespace {

namespace fs = std::filesystem;

const std::string unset = "REQUIRED";

} // namespace

struct Parameters::Implementation {
  struct Entry {
    std::string section, key, default_value, allowed, help;
    std::function<bool()> needed;         ///< empty: always
    bool given = false;                   ///< whether the file or the command line has set it
    const std::string* path_of = nullptr; ///< of the key of a file: the variable with its whole path
  };
  struct ChosenPreset {
    std::string section;
    std::vector<std::pair<std::string, Preset>> options;
    std::size_t chosen = 0;
  };
  dealii::ParameterHandler handler;
  std::vector<Entry> entries;
  std::vector<std::unique_ptr<ChosenPreset>> presets;
  fs::path base;               ///< folder that relative paths of the text being read are relative to
  std::vector<fs::path> files; ///< that were read

  /// Declares one key; `assign` checks and stores a value, and throws std::invalid_argument if it is bad.
  void declare(const std::string& section, const std::string& key, const std::string& default_value,
               const std::string& allowed, const std::string& help,
               const std::function<void(const std::string&, bool store)>& assign) {
    const std::size_t place = entries.size();
    entries.push_back({section, key, default_value, allowed, help, {}, false, nullptr});
    enter(section);
    handler.declare_entry(key, default_value,
                          Checked(
                              [assign](const std::string& text) {
                                if (text != unset) assign(text, false);
                              },
                              allowed),
                          help);
    handler.add_action(key, [this, place, assign](const std::string& text) {
      entries[place].given = true;
      if (text != unset) assign(text, true);
    });
    entries[place].given = false; // add_action() has called the action with the default, which does not count
    leave(section);
  }

  /// Turns deal.II's messages of several lines into one: `file:line: key: found, allowed`.
  std::string one_line(const dealii::ExceptionBase& error, const std::string& where, int shift) const {
    std::ostringstream stream;
    error.print_info(stream);
    std::string text = std::regex_replace(stream.str(), std::regex("\\s+"), " ");
    text.erase(text.find_last_not_of(' ') + 1);
    std::smatch m;
    // deal.II's message lacks the closing bracket of the file name if a subsection is unknown.
    if (std::regex_search(text, m, std::regex("Line <(\\d+)> of file <([^>:]*)>?: ?(.*)"))) {
      const std::string place =
          where.empty() ? m[2].str() + ":" + std::to_string(std::stoi(m[1].str()) + shift) : where;
      std::string rest = m[3];
      if (std::regex_search(
              rest, m,
              std::regex("The entry value (.*) for the entry named (.*) does not match the given "
                         "pattern: (.*)")))
        rest = "key '" + m[2].str() + "': found '" + m[1].str() + "', allowed: " + m[3].str();
      else if (std::regex_search(rest, m, std::regex("No entry with name <(.*)> was declared")))
        rest = "unknown key '" + m[1].str() + "'" + nearest(m[1].str());
      else if (std::regex_search(rest, m, std::regex("no such subsection to be entered: ?(.*?) *$")))
        rest = "unknown subsection '" + m[1].str() + "'" + did_you_mean(m[1].str(), section_names());
      text = place + ": " + rest;
    }
    return text;
  }

  /// Names of the sections, each without those around it.
  std::vector<std::string> section_names() const {
    std::vector<std::string> names;
    for (const Entry& entry : entries) names.push_back(entry.section.substr(entry.section.rfind('/') + 1));
    return names;
  }

  /// Returns " (did you mean 'Section/Key'?)" for a misspelt key, from the smallest edit distance.
  std::string nearest(const std::string& word) const {
    const Entry* best = nullptr;
    std::size_t best_distance = word.size() / 2 + 1;
    for (const Entry& entry : entries)
      if (const std::size_t distance = edit_distance(word, entry.key); distance < best_distance)
        best = &entry, best_distance = distance;
    return best ? " (did you mean '" + best->section + "/" + best->key + "'?)" : "";
  }

  /// Parses one part of the text inside the sections that are open there.
  void parse(const InputText::Part& part) {
    base = fs::absolute(part.file).parent_path();
    std::string text;
    for (const std::string& name : part.open) text += "subsection " + name + "\n";
    text += part.text;
    // Sections that are open at the end of this part continue in a later one; here they are closed.
    static const std::regex subsection("^\\s*subsection\\s"), end("^\\s*end\\s*(#.*)?$");
    std::size_t depth = part.open.size();
    std::istringstream lines(part.text);
    for (std::string line; std::getline(lines, line);)
      depth = std::regex_search(line, subsection) ? depth + 1
              : std::regex_match(line, end)       ? depth - 1
                                                  : depth;
    for (; depth > 0; --depth) text += "end\n";
    std::istringstream stream(text);
    parse(stream, part.file.string(), "", part.first_line - 1 - static_cast<int>(part.open.size()));
  }

  /// Sets one key as a file would. @param name name of the source @param where replaces file and line in
  /// messages
  void set(const std::string& section, const std::string& key, const std::string& value,
           const std::string& name, const std::string& where) {
    std::string before, after;
    for (const std::string& part : split(section, '/'))
      before += "subsection " + part + "\n", after += "end\n";
    std::istringstream lines(before + "set " + key + " = " + value + "\n" + after);
    parse(lines, name, where);
  }

  /// Sets those keys of the chosen presets that neither the file nor the command line has set.
  void apply_presets() {
    for (const auto& preset : presets)
      for (const auto& [key, value] : preset->options[preset->chosen].second) {
        const auto entry = std::find_if(entries.begin(), entries.end(), [&, &name = key](const Entry& e) {
          return e.section == preset->section && e.key == name;
        });
        if (entry != entries.end() && entry->given) continue;
        set(preset->section, key, value, "preset",
            "preset '" + preset->options[preset->chosen].first + "' of section '" + preset->section + "'");
      }
  }

  /// @param where replaces file and line in messages @param shift is added to the line numbers
  void parse(std::istream& text, const std::string& name, const std::string& where, int shift = 0) {
    try {
      handler.parse_input(text, name);
    } catch (const dealii::ExceptionBase& error) {
      throw InputError(one_line(error, where, shift));
    }
  }

  void enter(const std::string& section) {
    for (const std::string& name : split(section, '/')) handler.enter_subsection(name);
  }
  void leave(const std::string& section) {
    for (std::size_t n = split(section, '/').size(); n > 0; --n) handler.leave_subsection();
  }
  /// The text that a key was set to.
  std::string value(const Entry& entry) {
    enter(entry.section);
    const std::string text = handler.get(entry.key);
    leave(entry.section);
    return text;
  }

  /// What is set in a section and in those inside it, in the order of their declaration.
  std::string section_text(const std::string& section, int depth) {
    const std::string indent(2 * static_cast<std::size_t>(depth), ' ');
    std::vector<std::pair<std::string, std::string>> keys;
    std::vector<std::string> inside;
    std::size_t width = 0;
    for (const Entry& entry : entries) {
      if (entry.section == section) {
        const std::string set = entry.path_of != nullptr ? *entry.path_of : value(entry);
        if (set == unset) continue;
        keys.emplace_back(entry.key, set);
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
      const std::string below = section_text(section.empty() ? name : section + "/" + name, depth + 1);
      if (!below.empty()) text += indent + "subsection " + name + "\n" + below + indent + "end\n";
    }
    return text;
  }

  /// Returns the section that `path` and a key of the command line refer to: the section `path` itself, or
  /// the only one that ends with it; if several do, the only one that the file opens.
  std::string section_of(const std::string& path, const std::string& key, const std::string& text,
                         const std::vector<InputText::Opening>& openings) const {
    std::vector<std::string> found, opened;
    for (const Entry& entry : entries) {
      if (entry.section == path) return path;
      if (entry.key == key && entry.section.ends_with("/" + path) &&
          std::find(found.begin(), found.end(), entry.section) == found.end())
        found.push_back(entry.section);
    }
    for (const std::string& section : found)
      if (std::any_of(openings.begin(), openings.end(), [&](const auto& o) { return o.path == section; }))
        opened.push_back(section);
    if (!opened.empty()) found = opened;
    if (found.size() < 2) return found.empty() ? path : found.front();
    std::string list;
    for (const std::string& section : found) list += (list.empty() ? "" : ", ") + section + "/" + key;
    throw InputError("command line: '" + text + "' could mean " + list);
  }
};

Parameters::Parameters() : implementation(std::make_unique<Implementation>()) {}
Parameters::~Parameters() = default;

void Parameters::Section::quantity(const std::string& key, double& variable, Dimension dimension, Range range,
                                   const std::string& help) {
  const std::string kind = dimension == Dimension::none
                               ? "a number "
                               : "a number with its unit (" + accepted_units(dimension) + ") ";
  parameters.implementation->declare(section, key,
                                     std::isnan(variable) ? unset : format_quantity(variable, dimension),
                                     kind + range_words(range, dimension), help,
                                     [&variable, dimension, range](const std::string& text, bool store) {
                                       const double value = in_range(parse_quantity(text, dimension), range);
                                       if (store) variable = value;
                                     });
  parameters.implementation->entries.back().needed = needed;
}

void Parameters::Section::number(const std::string& key, double& variable, Range range,
                                 const std::string& help) {
  quantity(key, variable, Dimension::none, range, help);
}

void Parameters::Section::integer(const std::string& key, int& variable, Range range,
                                  const std::string& help) {
  parameters.implementation->declare(section, key, std::to_string(variable),
                                     "a whole number " + range_words(range, Dimension::none), help,
                                     [&variable, range](const std::string& text, bool store) {
                                       int value = 0;
                                       const auto end = text.data() + text.size();
                                       const auto [rest, status] = std::from_chars(text.data(), end, value);
                                       if (status != std::errc() || rest != end)
                                         throw std::invalid_argument("not a whole number");
                                       in_range(value, range);
                                       if (store) variable = value;
                                     });
}

void Parameters::Section::flag(const std::string& key, bool& variable, const std::string& help) {
  choice(key, variable, std::vector<std::pair<std::string, bool>>{{"yes", true}, {"no", false}}, help);
}

void Parameters::Section::text(const std::string& key, std::string& variable, const std::string& help) {
  parameters.implementation->declare(section, key, variable, "text", help,
                                     [&variable](const std::string& text, bool store) {
                                       if (store) variable = text;
                                     });
}

void Parameters::Section::file(const std::string& key, std::string& variable, const std::string& help) {
  auto& base = parameters.implementation->base;
  parameters.implementation->declare(
      section, key, variable, "a path", help, [&variable, &base](const std::string& text, bool store) {
        if (!store) return;
        const fs::path path(text);
        variable = text.empty() || path.is_absolute() ? text : (base / path).lexically_normal().string();
      });
  parameters.implementation->entries.back().path_of = &variable;
}

void Parameters::Section::quantities(const std::string& key, std::vector<double>& variable,
                                     Dimension dimension, Range range, const std::string& help) {
  std::string joined;
  for (double value : variable) joined += (joined.empty() ? "" : ", ") + format_quantity(value, dimension);
  parameters.implementation->declare(
      section, key, joined,
      "a list of numbers with units (" + accepted_units(dimension) + ") " + range_words(range, dimension),
      help, [&variable, dimension, range](const std::string& text, bool store) {
        std::vector<double> values;
        for (const std::string& item : split(text))
          values.push_back(in_range(parse_quantity(item, dimension), range));
        if (store) variable = values;
      });
}

void Parameters::Section::words(const std::string& key, std::vector<std::string>& variable,
                                const std::vector<std::string>& allowed, const std::string& help) {
  std::string joined, list;
  for (const auto& word : variable) joined += (joined.empty() ? "" : ", ") + word;
  for (const auto& word : allowed) list += (list.empty() ? "" : ", ") + word;
  parameters.implementation->declare(section, key, joined, "words out of " + list, help,
                                     [&variable, allowed](const std::string& text, bool store) {
                                       const auto items = split(text);
                                       for (const auto& item : items)
                                         if (std::find(allowed.begin(), allowed.end(), item) == allowed.end())
                                           throw std::invalid_argument("unknown word");
                                       if (store) variable = items;
                                     });
}

void Parameters::Section::choose(const std::string& key, const std::vector<std::string>& names,
                                 std::size_t current, std::function<void(std::size_t)> assign,
                                 const std::string& help) {
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "" : " | ") + name;
  parameters.implementation->declare(section, key, names.at(current), list, help,
                                     [names, assign](const std::string& text, bool store) {
                                       const auto found = std::find(names.begin(), names.end(), text);
                                       if (found == names.end()) throw std::invalid_argument("unknown word");
                                       if (store) assign(found - names.begin());
                                     });
}

void Parameters::Section::preset(const std::string& key,
                                 const std::vector<std::pair<std::string, Preset>>& options,
                                 const std::string& help) {
  auto& all = parameters.implementation->presets;
  all.push_back(
      std::make_unique<Implementation::ChosenPreset>(Implementation::ChosenPreset{section, options}));
  std::vector<std::string> names;
  std::string meaning = help;
  for (const auto& [name, values] : options) {
    names.push_back(name);
    if (values.empty()) continue;
    meaning += "; " + name + ": ";
    for (std::size_t i = 0; i < values.size(); ++i)
      meaning += (i > 0 ? ", " : "") + values[i].first + " = " + values[i].second;
  }
  choose(
      key, names, 0, [chosen = &all.back()->chosen](std::size_t i) { *chosen = i; }, meaning);
}

void Parameters::read(const InputText& text, const std::vector<std::string>& overrides) {
  for (const InputText::Part& part : text.parts) {
    implementation->parse(part);
    implementation->files.push_back(part.file);
  }
  implementation->base = fs::current_path();
  for (const std::string& word : overrides) {
    std::smatch m;
    if (!std::regex_match(word, m, std::regex("([^=]+)/([^/=]+)=(.*)")))
      throw InputError("command line: expected Section/Key=value, found '" + word + "'");
    implementation->set(implementation->section_of(m[1], m[2], word, text.openings), m[2], m[3],
                        "command line", "command line: '" + word + "'");
  }
  implementation->apply_presets();
  for (const auto& entry : implementation->entries) {
    if (implementation->value(entry) == unset && (!entry.needed || entry.needed()))
      throw InputError(text.file.string() + ": key '" + entry.section + "/" + entry.key +
                       "' must be set, allowed: " + entry.allowed);
  }
}

std::string Parameters::resolved() const { return implementation->section_text("", 0); }

std::vector<fs::path> Parameters::files() const {
  std::vector<fs::path> all = implementation->files;
  for (const auto& entry : implementation->entries)
    if (entry.path_of != nullptr && !entry.path_of->empty()) all.emplace_back(*entry.path_of);
  return all;
}

std::string Parameters::help() const {
  std::ostringstream stream;
  std::string section;
  for (const auto& entry : implementation->entries) {
    if (entry.section != section) stream << "\n" << (section = entry.section) << "\n";
    stream << "  " << entry.section << "/" << entry.key << "\n      " << entry.help
           << "\n      default: " << (entry.default_value.empty() ? "(empty)" : entry.default_value)
           << "; allowed: " << entry.allowed << "\n";
  }
  return stream.str();
}

} // namespace spall
