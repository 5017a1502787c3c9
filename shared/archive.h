#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace spall {

/// A contiguous array whose type is known by the size of its items only.
class Sequence {
public:
  explicit Sequence(std::size_t item_bytes_) : item_bytes(item_bytes_) {}
  virtual ~Sequence() = default;
  virtual std::size_t count() const = 0;
  virtual void resize(std::size_t count) = 0;
  virtual void* data() = 0;
  std::size_t bytes() const { return count() * item_bytes; }

  const std::size_t item_bytes;
};

/// What an object keeps from step to step is said once, in its member `void transfer(Archive&)`, which names
/// every part of its state. Archives do with the parts what they are for: save them, load them, count them.
/// The same members in the same order, whichever archive it is. Names are those of streams: a name may come
/// again, and its parts then follow one another.
class Archive {
public:
  virtual ~Archive() = default;

  /// True if the members get values: what follows from them must then be made anew.
  virtual bool loading() const = 0;

  /// Numbers, enumerations and structs of such.
  template<class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(const char* name, T& value) { item(name, &value, sizeof value); }
  template<class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(const char* name, std::vector<T>& values) {
    class Values final : public Sequence {
    public:
      explicit Values(std::vector<T>& v) : Sequence(sizeof(T)), values(v) {}
      std::size_t count() const override { return values.size(); }
      void resize(std::size_t count) override { values.resize(count); }
      void* data() override { return values.data(); }

    private:
      std::vector<T>& values;
    } sequence(values);
    array(name, sequence);
  }
  void operator()(const char* name, std::string& text) {
    std::vector<char> letters(text.begin(), text.end());
    (*this)(name, letters);
    text.assign(letters.begin(), letters.end());
  }
  /// A list of what has a state of its own, or lists, or texts.
  template<class T>
  requires(!std::is_trivially_copyable_v<T>) void operator()(const char* name, std::vector<T>& list) {
    std::uint64_t count = list.size();
    (*this)(name, count);
    list.resize(count);
    for (T& one : list) {
      if constexpr (requires { one.transfer(*this); })
        one.transfer(*this);
      else
        (*this)(name, one);
    }
  }

protected:
  virtual void item(const char* name, void* value, std::size_t bytes) = 0;
  virtual void array(const char* name, Sequence& values) = 0;
};

} // namespace spall
