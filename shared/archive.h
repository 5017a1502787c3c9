#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
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

/// The first items of a vector, whatever follows them.
template<class T> class FirstItems final : public Sequence {
public:
  FirstItems(std::vector<T>& values_, std::size_t count_)
      : Sequence(sizeof(T)), values(values_), items(count_) {}
  std::size_t count() const override { return items; }
  void resize(std::size_t count) override { values.resize(items = count); }
  void* data() override { return values.data(); }

private:
  std::vector<T>& values;
  std::size_t items;
};

/// What an object keeps from step to step is said once, in its member `void transfer(Archive&)`, which names
/// every part of its state. Archives do with the parts what they are for: save them, load them, count them.
/// The same members in the same order, whichever archive it is; names need not differ. With several ranks all
/// transfer together: what is not said to be spread over them is the same on all of them.
class Archive {
public:
  virtual ~Archive() = default;

  /// True if the members get values: what follows from them must then be made anew.
  virtual bool loading() const = 0;

  /// Moves the k-th of this rank's pieces of a list.
  using Piece = std::function<void(std::size_t k, Archive& archive)>;
  /// A list that is spread over the ranks, in their order, each of whose pieces has a state of its own. Of
  /// this rank are `count` pieces. The list must have a name of its own, and be as long on loading as it was.
  virtual void pieces(const std::string& /*name*/, std::size_t count, const Piece& piece) {
    for (std::size_t k = 0; k < count; ++k) piece(k, *this);
  }
  /// What belongs to this rank alone, and follows from the rest, but for round-off.
  /// @return false if it cannot be loaded, as there are more or fewer ranks than there were
  virtual bool of_rank(const std::function<void(Archive&)>& part) {
    part(*this);
    return true;
  }

  /// Numbers, enumerations and structs of such.
  template<class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(const char* name, T& value) { item(name, &value, sizeof value); }
  template<class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(const char* name, std::vector<T>& values) {
    FirstItems<T> all(values, values.size());
    array(name, all);
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

  // What an archive does: all of the above ends here.
  virtual void item(const char* name, void* value, std::size_t bytes) = 0;
  virtual void array(const char* name, Sequence& values) = 0;
};

/// Moves of every array the part that belongs to the points [begin, end) of `points`, each of which has as
/// many items as the others, and nothing else. On loading the arrays have their lengths already.
class Slice final : public Archive {
public:
  Slice(Archive& archive_, std::size_t begin_, std::size_t end_, std::size_t points_)
      : archive(archive_), begin(begin_), end(end_), points(points_) {}
  bool loading() const override { return archive.loading(); }
  void item(const char*, void*, std::size_t) override {}
  void array(const char* name, Sequence& values) override {
    class Part final : public Sequence {
    public:
      Part(Sequence& whole_, std::size_t first_, std::size_t count_)
          : Sequence(whole_.item_bytes), whole(whole_), first(first_), items(count_) {}
      std::size_t count() const override { return items; }
      void resize(std::size_t n) override {
        if (n != items) throw std::runtime_error("a part of an array has another length than it had");
      }
      void* data() override { return static_cast<std::byte*>(whole.data()) + first * item_bytes; }

    private:
      Sequence& whole;
      std::size_t first, items;
    };
    const std::size_t each = values.count() / points;
    Part part(values, begin * each, (end - begin) * each);
    archive.array(name, part);
  }

private:
  Archive& archive;
  std::size_t begin, end, points;
};

} // namespace spall
