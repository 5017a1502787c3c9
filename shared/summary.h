#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace spall {

/// The flat JSON object `summary.json`: SI numbers at the top level, in the order in which they were set.
class Summary {
public:
  void set(const std::string& key, double value); ///< NaN and infinity become null
  void set(const std::string& key, int value) { set_raw(key, std::to_string(value)); }
  void set(const std::string& key, std::size_t value) { set_raw(key, std::to_string(value)); }
  void set(const std::string& key, bool value) { set_raw(key, value ? "true" : "false"); }
  void set(const std::string& key, const std::string& value);
  void set(const std::string& key, const char* value) { set(key, std::string(value)); }

  /// Takes over all entries of another summary.
  void add(const Summary& other);
  /// Makes the values of all keys null.
  void forget_values();

  std::string json() const;
  /// Writes the file atomically: under a temporary name, which is then renamed.
  void write(const std::filesystem::path& file) const;

private:
  void set_raw(const std::string& key, const std::string& text);
  std::vector<std::pair<std::string, std::string>> entries;
};

} // namespace spall
