#pragma once

#include "shared/input/input_text.h"
#include "shared/input/quantity.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace spall {

/// Closed range allowed for a number, in SI.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};
/// Smallest positive number: for ranges that exclude zero.
inline constexpr double above_zero = std::numeric_limits<double>::min();
/// Default of a number that has none: the file must set it.
inline constexpr double required = std::numeric_limits<double>::quiet_NaN();

/// When a key without a default must be set.
struct Needed {
  std::function<bool()> when; ///< asked after everything was read; empty: always
  std::string words;          ///< "Shape = block"; empty: not said

  bool now() const { return !when || when(); }
  /// "must be set if Shape = block", for help and messages.
  std::string describe() const;
  /// Of a key that may stay unset.
  static Needed never() {
    return {[] { return false; }, ""};
  }
};
/// Both must hold.
Needed operator&&(const Needed& a, const Needed& b);

/// The words of a key and what they stand for.
template<class Enum> using Choices = std::vector<std::pair<std::string, Enum>>;

/// The variable of `key` must have one of the values.
template<class Enum>
Needed needed_if(const std::string& key, const Enum& variable, const Choices<Enum>& choices,
                 const std::vector<Enum>& values) {
  std::string words;
  for (const auto& [word, value] : choices)
    if (std::find(values.begin(), values.end(), value) != values.end())
      words += (words.empty() ? key + " = " : " or ") + word;
  return {[&variable, values] { return std::find(values.begin(), values.end(), variable) != values.end(); },
          words};
}

/// The inputs of one program: each key is stated once, with unit, range, default and help, and bound to the
/// variable that receives it. Bound variables must outlive this object. The variable's value at the time of
/// declaration is the default. InputText says what a file looks like.
class Parameters {
public:
  Parameters();
  ~Parameters();
  Parameters(const Parameters&) = delete;
  Parameters& operator=(const Parameters&) = delete;

  /// Keys of a section with the texts that a file would set them to.
  using Preset = std::vector<std::pair<std::string, std::string>>;

  /// One `subsection NAME ... end` of the file, or a nested one.
  class Section {
  public:
    /// A dimensional value, whose unit is mandatory in the file. With the default `required` (NaN) it must be
    /// set.
    void quantity(const std::string& key, double& variable, Dimension dimension, Range range,
                  const std::string& help);
    /// A pure number.
    void number(const std::string& key, double& variable, Range range, const std::string& help);
    void integer(const std::string& key, int& variable, Range range, const std::string& help);
    void flag(const std::string& key, bool& variable, const std::string& help);
    void text(const std::string& key, std::string& variable, const std::string& help);
    /// A path. A relative path refers to the folder of the file that sets it (on the command line to the
    /// current folder). An empty value stays empty.
    void file(const std::string& key, std::string& variable, const std::string& help);
    /// Comma-separated dimensional values, each with its unit.
    void quantities(const std::string& key, std::vector<double>& variable, Dimension dimension, Range range,
                    const std::string& help);
    /// Comma-separated words out of a list (possibly none).
    void words(const std::string& key, std::vector<std::string>& variable,
               const std::vector<std::string>& allowed, const std::string& help);
    /// One word out of a list, bound to an enumeration.
    template<class Enum>
    void choice(const std::string& key, Enum& variable, const Choices<std::type_identity_t<Enum>>& options,
                const std::string& help) {
      std::vector<std::string> names;
      std::size_t current = 0;
      for (std::size_t i = 0; i < options.size(); ++i) {
        names.push_back(options[i].first);
        if (options[i].second == variable) current = i;
      }
      choose(
          key, names, current, [&variable, options](std::size_t i) { variable = options[i].second; }, help);
    }

    /// One word that stands for the values of several keys of this section, which must be declared already.
    /// A key that the file or the command line sets itself wins over the word, wherever it is set. The first
    /// option is the default.
    void preset(const std::string& key, const std::vector<std::pair<std::string, Preset>>& options,
                const std::string& help);

  private:
    friend class Parameters;
    Section(Parameters& owner, std::string name, Needed needed_)
        : parameters(owner), section(std::move(name)), needed(std::move(needed_)) {}
    void choose(const std::string& key, const std::vector<std::string>& names, std::size_t current,
                std::function<void(std::size_t)> assign, const std::string& help);
    Parameters& parameters;
    std::string section;
    Needed needed;
  };
  /// Opens a section for declarations; the same name may be opened again. "slab/AFC" is the section AFC
  /// inside the section slab. Its keys without a default must be set when they are `needed` (the constants of
  /// a material only if its law was chosen); otherwise they may stay NaN.
  Section section(const std::string& name, Needed needed = {}) { return {*this, name, std::move(needed)}; }

  /// Reads a file, then applies `Section/Key=value` overrides. The outer sections of a nested one may be left
  /// out where only one section of the file fits: AFC/C1 means slab/AFC/C1 if the file opens no other section
  /// AFC.
  /// @throws InputError: one line with file, line, key, found and allowed.
  void read(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    read(InputText::read(file), overrides);
  }
  void read(const InputText& text, const std::vector<std::string>& overrides);

  /// Every key that has a value, in the input format: what a run really used. Paths are absolute, so that
  /// reading it again gives the same inputs wherever it lies; keys without a value that nothing asked for are
  /// left out.
  std::string resolved() const;

  /// The files that were read and those that keys name.
  std::vector<std::filesystem::path> files() const;
  /// Those that keys name alone: their contents are not part of resolved().
  std::vector<std::filesystem::path> named_files() const;

  /// A line for every key of a file that an include after it has set anew.
  const std::vector<std::string>& warnings() const;

  /// Every key with unit, default, range and meaning, for `--help`. @param topic a section or a key, of which
  /// outer sections and capitals may be left out: only what it names; empty: all
  /// @throws InputError: nothing has that name
  std::string help(const std::string& topic = "") const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation;
};

} // namespace spall
