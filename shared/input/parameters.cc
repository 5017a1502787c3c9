#include "shared/input/parameters.h"

#include "shared/error.h"

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>

namespace spall {
namespace {

namespace fs = std::filesystem;

const std::string unset = "REQUIRED";

/// A deal.II pattern that says in words what a key takes and checks it with a function that throws.
class Checked : public dealii::Patterns::PatternBase {
public:
  Checked(std::function<void(const std::string&)> check_, std::string words_)
      : check(std::move(check_)), words(std::move(words_)) {}
  bool match(const std::string& text) const override {
    try {
      check(text);
      return true;
    } catch (const std::invalid_argument&) {
      return false;
    }
  }
  std::string description(OutputStyle = Machine) const override { return words; }
  std::unique_ptr<PatternBase> clone() const override { return std::make_unique<Checked>(*this); }

private:
  std::function<void(const std::string&)> check;
  std::string words;
};

std::string range_words(Range range, Dimension dimension) {
  std::string words;
  if (range.min == above_zero)
    words = "> 0";
  else if (std::isfinite(range.min))
    words = ">= " + format_quantity(range.min, dimension);
  if (std::isfinite(range.max))
    words += std::string(words.empty() ? "" : " and ") + "<= " + format_quantity(range.max, dimension);
  return words.empty() ? "any value" : words;
}

double in_range(double value, Range range) {
  if (!(value >= range.min && value <= range.max)) throw std::invalid_argument("out of range");
  return value;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> items;
  std::stringstream stream(text);
  for (std::string item; std::getline(stream, item, ',');) {
    const auto begin = item.find_first_not_of(" \t");
    if (begin == std::string::npos) continue;
    items.push_back(item.substr(begin, item.find_last_not_of(" \t") - begin + 1));
  }
  return items;
}

} // namespace

struct Parameters::Implementation {
  struct Entry {
    std::string section, key, default_value, allowed, help;
    std::function<bool()> needed; ///< empty: always
    bool given = false;           ///< whether the file or the command line has set it
  };
  struct ChosenPreset {
    std::string section;
    std::vector<std::pair<std::string, Preset>> options;
    std::size_t chosen = 0;
  };
  dealii::ParameterHandler handler;
  std::vector<Entry> entries;
  std::vector<std::unique_ptr<ChosenPreset>> presets;
  fs::path base;                ///< folder that relative paths of the text being read are relative to
  std::set<fs::path> including; ///< files on the way from the first one to the one being read

  /// Declares one key; `assign` checks and stores a value, and throws std::invalid_argument if it is bad.
  void declare(const std::string& section, const std::string& key, const std::string& default_value,
               const std::string& allowed, const std::string& help,
               const std::function<void(const std::string&, bool store)>& assign) {
    const std::size_t place = entries.size();
    entries.push_back({section, key, default_value, allowed, help, {}, false});
    handler.enter_subsection(section);
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
    entries[place].given = false; // so far the action was called with the default only
    handler.leave_subsection();
  }

  /// Turns deal.II's messages of several lines into one: `file:line: key: found, allowed`.
  std::string one_line(const dealii::ExceptionBase& error, const std::string& where) const {
    std::ostringstream stream;
    error.print_info(stream);
    std::string text = std::regex_replace(stream.str(), std::regex("\\s+"), " ");
    text.erase(text.find_last_not_of(' ') + 1);
    std::smatch m;
    // deal.II forgets the closing bracket of the file name where a subsection is unknown.
    if (std::regex_search(text, m, std::regex("Line <(\\d+)> of file <([^>:]*)>?: ?(.*)"))) {
      const std::string place = where.empty() ? m[2].str() + ":" + m[1].str() : where;
      std::string rest = m[3];
      if (std::regex_search(
              rest, m,
              std::regex("The entry value (.*) for the entry named (.*) does not match the given "
                         "pattern: (.*)")))
        rest = "key '" + m[2].str() + "': found '" + m[1].str() + "', allowed: " + m[3].str();
      else if (std::regex_search(rest, m, std::regex("No entry with name <(.*)> was declared")))
        rest = "unknown key '" + m[1].str() + "'" + nearest(m[1].str());
      else if (std::regex_search(rest, m, std::regex("no such subsection to be entered: ?(.*?) *$")))
        rest = "unknown subsection '" + m[1].str() + "'";
      text = place + ": " + rest;
    }
    return text;
  }

  /// " (did you mean 'Section/Key'?)" for a misspelt key, from the smallest edit distance.
  std::string nearest(const std::string& word) const {
    const Entry* best = nullptr;
    std::size_t best_distance = word.size() / 2 + 1;
    for (const Entry& entry : entries) {
      std::vector<std::size_t> row(entry.key.size() + 1);
      for (std::size_t j = 0; j < row.size(); ++j) row[j] = j;
      for (std::size_t i = 1; i <= word.size(); ++i) {
        std::size_t diagonal = row[0]++;
        for (std::size_t j = 1; j < row.size(); ++j) {
          const std::size_t change = diagonal + (word[i - 1] != entry.key[j - 1]);
          diagonal = row[j];
          row[j] = std::min({row[j] + 1, row[j - 1] + 1, change});
        }
      }
      if (row.back() < best_distance) best = &entry, best_distance = row.back();
    }
    return best ? " (did you mean '" + best->section + "/" + best->key + "'?)" : "";
  }

  /// Reads a file after the files it includes, so that its own values win. Line numbers stay those of the
  /// file.
  void read_file(const fs::path& file) {
    std::ifstream stream(file);
    if (!stream) throw InputError(file.string() + ": cannot be opened");
    if (!including.insert(fs::absolute(file).lexically_normal()).second)
      throw InputError(file.string() + ": includes itself");
    std::string own;
    int number = 0;
    for (std::string line; std::getline(stream, line);) {
      ++number;
      std::smatch m;
      if (std::regex_match(line, m, std::regex("\\s*include\\s+(.*?)\\s*"))) {
        const fs::path included = file.parent_path() / m[1].str();
        if (!fs::exists(included))
          throw InputError(file.string() + ":" + std::to_string(number) + ": include: '" + included.string() +
                           "' does not exist");
        read_file(included);
        line.clear();
      }
      own += line + "\n";
    }
    including.erase(fs::absolute(file).lexically_normal());
    base = fs::absolute(file).parent_path();
    std::istringstream text(own);
    parse(text, file.string(), "");
  }

  /// Sets one key as a file would; `where` names the source in messages.
  void set(const std::string& section, const std::string& key, const std::string& value,
           const std::string& where) {
    std::istringstream lines("subsection " + section + "\nset " + key + " = " + value + "\nend\n");
    parse(lines, where, where);
  }

  /// Sets the keys of the chosen presets that nobody has set.
  void apply_presets() {
    for (const auto& preset : presets)
      for (const auto& [key, value] : preset->options[preset->chosen].second) {
        const auto entry = std::find_if(entries.begin(), entries.end(), [&](const Entry& e) {
          return e.section == preset->section && e.key == key;
        });
        if (entry != entries.end() && entry->given) continue;
        set(preset->section, key, value,
            "preset '" + preset->options[preset->chosen].first + "' of section '" + preset->section + "'");
      }
  }

  void parse(std::istream& text, const std::string& name, const std::string& where) {
    try {
      handler.parse_input(text, name);
    } catch (const dealii::ExceptionBase& error) {
      throw InputError(one_line(error, where));
    }
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
                                         throw std::invalid_argument("no whole number");
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

void Parameters::read(const fs::path& file, const std::vector<std::string>& overrides) {
  implementation->read_file(file);
  implementation->base = fs::current_path();
  for (const std::string& text : overrides) {
    std::smatch m;
    if (!std::regex_match(text, m, std::regex("([^/=]+)/([^=]+)=(.*)")))
      throw InputError("command line: '" + text + "' is no Section/Key=value");
    implementation->set(m[1].str(), m[2].str(), m[3].str(), "command line: '" + text + "'");
  }
  implementation->apply_presets();
  for (const auto& entry : implementation->entries) {
    implementation->handler.enter_subsection(entry.section);
    const bool missing = implementation->handler.get(entry.key) == unset;
    implementation->handler.leave_subsection();
    if (missing && (!entry.needed || entry.needed()))
      throw InputError(file.string() + ": key '" + entry.section + "/" + entry.key +
                       "' must be set, allowed: " + entry.allowed);
  }
}

std::string Parameters::resolved() const {
  std::ostringstream stream;
  implementation->handler.print_parameters(stream, dealii::ParameterHandler::PRM |
                                                       dealii::ParameterHandler::Short |
                                                       dealii::ParameterHandler::KeepDeclarationOrder);
  return stream.str();
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
