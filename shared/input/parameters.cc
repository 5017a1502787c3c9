#include "shared/input/parameters.h"

#include "shared/error.h"
#include "shared/input/entries.h"
#include "shared/input/words.h"
#include "shared/nearest.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace spall {
namespace {

namespace fs = std::filesystem;

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

/// A range without the sizes that no quantity of the dimension has.
Range within_magnitudes(Range range, Dimension dimension) {
  const auto [smallest, largest] = magnitudes(dimension);
  if (range.min == above_zero && smallest > 0) range.min = smallest;
  return {std::max(range.min, -largest), std::min(range.max, largest)};
}

double in_range(double value, Range range) {
  if (!(value >= range.min && value <= range.max)) throw std::invalid_argument("out of range");
  return value;
}

/// @throws std::invalid_argument if the word is none of the list
std::size_t place_in(const std::vector<std::string>& list, const std::string& word) {
  const auto found = std::find(list.begin(), list.end(), word);
  if (found == list.end()) throw std::invalid_argument("unknown word");
  return static_cast<std::size_t>(found - list.begin());
}

} // namespace

struct Parameters::Implementation {
  struct ChosenPreset {
    std::string section;
    std::vector<std::pair<std::string, Preset>> options;
    std::size_t chosen = 0;
  };
  Entries entries;
  std::vector<std::unique_ptr<ChosenPreset>> presets;
  fs::path base;               ///< folder that relative paths of the value being set are relative to
  std::vector<fs::path> files; ///< that were read
  std::vector<std::string> warnings;

  /// Sets those keys of the chosen presets that neither the file nor the command line has set.
  void apply_presets() {
    for (const auto& preset : presets) {
      const auto& [name, values] = preset->options[preset->chosen];
      for (const auto& [key, value] : values)
        if (const Entry* entry = entries.find(preset->section, key); entry == nullptr || !entry->given)
          entries.set(preset->section, key, value,
                      "preset '" + name + "' of section '" + preset->section + "'");
    }
  }

  /// Reads a word of the command line. @throws InputError
  void set_by_word(const std::string& word, const std::vector<InputText::Opening>& openings) {
    const std::string where = "command line: '" + word + "'";
    const std::size_t equals = word.find('=');
    const std::vector<std::string> names = split(word.substr(0, equals), '/');
    if (equals == std::string::npos || names.empty())
      throw InputError("command line: expected Section/Key=value, found '" + word + "'");
    if (word.find('\n') != std::string::npos) throw InputError(where + ": a value has no line break");
    const std::string &key = names.back(), section = joined({names.begin(), names.end() - 1});
    if (section.empty())
      throw InputError("command line: expected Section/Key=value, found '" + word + "'" +
                       entries.with_sections(key));
    entries.set(entries.section_of(section, key, word, openings), key, trimmed(word.substr(equals + 1)),
                where);
  }
};

std::string Needed::describe() const {
  if (!when) return "must be set";
  return words.empty() ? "not set by default" : "must be set if " + words;
}

Needed operator&&(const Needed& a, const Needed& b) {
  if (!a.when) return b;
  if (!b.when) return a;
  return {[a, b] { return a.when() && b.when(); },
          a.words + (a.words.empty() || b.words.empty() ? "" : " and ") + b.words};
}

Parameters::Parameters() : implementation(std::make_unique<Implementation>()) {}
Parameters::~Parameters() = default;

void Parameters::Section::quantity(const std::string& key, double& variable, Dimension dimension, Range range,
                                   const std::string& help) {
  range = within_magnitudes(range, dimension);
  const std::string kind = dimension == Dimension::none
                               ? "a number "
                               : "a number with its unit (" + accepted_units(dimension) + ") ";
  auto& entry = parameters.implementation->entries.declare(
      {.section = section,
       .key = key,
       .value = {},
       .allowed = kind + range_words(range, dimension),
       .help = help,
       .assign = [&variable, dimension, range](const std::string& text) {
         variable = in_range(parse_quantity(text, dimension), range);
       }});
  if (std::isnan(variable))
    entry.needed = needed;
  else
    entry.value = format_quantity(variable, dimension);
}

void Parameters::Section::number(const std::string& key, double& variable, Range range,
                                 const std::string& help) {
  quantity(key, variable, Dimension::none, range, help);
}

void Parameters::Section::integer(const std::string& key, int& variable, Range range,
                                  const std::string& help) {
  parameters.implementation->entries.declare(
      {.section = section,
       .key = key,
       .value = std::to_string(variable),
       .allowed = "a whole number " + range_words(range, Dimension::none),
       .help = help,
       .assign = [&variable, range](const std::string& text) {
         const int value = parse_integer(text);
         in_range(value, range);
         variable = value;
       }});
}

void Parameters::Section::flag(const std::string& key, bool& variable, const std::string& help) {
  choice(key, variable, std::vector<std::pair<std::string, bool>>{{"yes", true}, {"no", false}}, help);
}

void Parameters::Section::text(const std::string& key, std::string& variable, const std::string& help) {
  parameters.implementation->entries.declare(
      {.section = section,
       .key = key,
       .value = variable,
       .allowed = "text",
       .help = help,
       .assign = [&variable](const std::string& text) { variable = text; }});
}

void Parameters::Section::file(const std::string& key, std::string& variable, const std::string& help) {
  parameters.implementation->entries.declare(
      {.section = section,
       .key = key,
       .value = variable,
       .allowed = "a path",
       .help = help,
       .assign =
           [&variable, &base = parameters.implementation->base](const std::string& text) {
             const fs::path path(text);
             variable = text.empty() || path.is_absolute() ? text : (base / path).lexically_normal().string();
           },
       .path_of = &variable});
}

void Parameters::Section::quantities(const std::string& key, std::vector<double>& variable,
                                     Dimension dimension, Range range, const std::string& help) {
  range = within_magnitudes(range, dimension);
  std::vector<std::string> defaults;
  for (const double value : variable) defaults.push_back(format_quantity(value, dimension));
  const std::string kind = dimension == Dimension::none ? "a list of different numbers "
                                                        : "a list of different numbers with units (" +
                                                              accepted_units(dimension) + ") ";
  parameters.implementation->entries.declare(
      {.section = section,
       .key = key,
       .value = joined(defaults, ", "),
       .allowed = kind + range_words(range, dimension),
       .help = help,
       .assign = [&variable, dimension, range](const std::string& text) {
         std::vector<double> values;
         for (const std::string& item : list_of(text))
           values.push_back(in_range(parse_quantity(item, dimension), range));
         variable = values;
       }});
}

void Parameters::Section::words(const std::string& key, std::vector<std::string>& variable,
                                const std::vector<std::string>& allowed, const std::string& help) {
  parameters.implementation->entries.declare(
      {.section = section,
       .key = key,
       .value = joined(variable, ", "),
       .allowed = "words out of " + joined(allowed, ", ") + ", each once",
       .help = help,
       .assign =
           [&variable, allowed](const std::string& text) {
             const std::vector<std::string> items = list_of(text);
             for (const std::string& item : items) place_in(allowed, item);
             variable = items;
           },
       .choices = allowed});
}

void Parameters::Section::choose(const std::string& key, const std::vector<std::string>& names,
                                 std::size_t current, std::function<void(std::size_t)> assign,
                                 const std::string& help) {
  parameters.implementation->entries.declare(
      {.section = section,
       .key = key,
       .value = names.at(current),
       .allowed = joined(names, " | "),
       .help = help,
       .assign = [names,
                  assign = std::move(assign)](const std::string& text) { assign(place_in(names, text)); },
       .choices = names});
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
  implementation->files = text.files;
  implementation->warnings = text.warnings;
  const auto where = [](const fs::path& file, int line) {
    return file.string() + ":" + std::to_string(line);
  };
  for (const InputText::Opening& opening : text.openings)
    implementation->entries.check_section(opening.path, where(opening.file, opening.line));
  for (const InputText::Setting& setting : text.settings) {
    implementation->base = fs::absolute(setting.file).parent_path();
    implementation->entries.set(setting.section, setting.key, setting.value,
                                where(setting.file, setting.line));
  }
  implementation->base = fs::current_path();
  for (const std::string& word : overrides) implementation->set_by_word(word, text.openings);
  implementation->apply_presets();
  for (const auto& entry : implementation->entries.list)
    if (!entry.value && entry.needed.now())
      throw InputError(text.file.string() + ": key '" + entry.path() + "' " + entry.needed.describe() +
                       ", allowed: " + entry.allowed);
}

std::string Parameters::resolved() const { return implementation->entries.text(); }

const std::vector<std::string>& Parameters::warnings() const { return implementation->warnings; }

std::vector<fs::path> Parameters::files() const {
  std::vector<fs::path> all = implementation->files;
  const std::vector<fs::path> named = named_files();
  all.insert(all.end(), named.begin(), named.end());
  return all;
}

std::vector<fs::path> Parameters::named_files() const {
  std::vector<fs::path> all;
  for (const auto& entry : implementation->entries.list)
    if (entry.path_of != nullptr && !entry.path_of->empty()) all.emplace_back(*entry.path_of);
  return all;
}

std::string Parameters::help(const std::string& topic) const {
  const std::string wanted = "/" + joined(split(lower_case(topic), '/')) + "/";
  std::string text, section;
  std::vector<std::string> names;
  if (topic.empty())
    text = "In an input file a later line replaces an earlier one, also if it comes from an include.\n"
           "A # begins a comment at the start of a line or after a blank; a value or file with such a #\n"
           "stands in double quotes.\n";
  for (const auto& entry : implementation->entries.list) {
    for (const std::string& name : split(entry.section, '/')) names.push_back(name);
    names.insert(names.end(), {entry.section, entry.path(), entry.key});
    if (wanted != "//" && ("/" + lower_case(entry.path()) + "/").find(wanted) == std::string::npos) continue;
    if (entry.section != section) text += "\n" + (section = entry.section) + "\n";
    const std::string initial = entry.value ? "default: " + (entry.value->empty() ? "(empty)" : *entry.value)
                                            : entry.needed.describe();
    text += "  " + entry.path() + "\n      " + entry.help + "\n      " + initial +
            "; allowed: " + entry.allowed + "\n";
  }
  if (text.empty())
    throw InputError("--help: found '" + topic + "', allowed: a section or a key of the inputs" +
                     did_you_mean(topic, names));
  return text;
}

} // namespace spall
