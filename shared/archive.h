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

/// A contiguous array of which only the size of an item is known, not its type.
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

/// The first `count` items of a vector; the items after them are not part of it.
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

/// An object states once what it keeps from step to step, in its member `void transfer(Archive&)`, which
/// passes every part of its state to the archive. Different archives save, load or count the parts. An object
/// must pass the same members in the same order to every archive; names need not differ. With several ranks
/// all ranks transfer together; a part that is not passed as spread over the ranks must be equal on all of
/// them.
class Archive {
public:
  virtual ~Archive() = default;

  /// True if the archive writes into the members, so that everything derived from them must be recomputed.
  virtual bool loading() const = 0;

  /// Bytes that can still come, while loading: a list has no more objects than these.
  virtual std::uint64_t left() const { return UINT64_MAX; }

  /// Moves the k-th of this rank's pieces of a list.
  using Piece = std::function<void(std::size_t k, Archive& archive)>;
  /// Transfers a list that is spread over the ranks, in their order, and whose pieces each have a state. This
  /// rank holds `count` pieces. The name of the list must be unique, and the list must be as long on loading
  /// as it was on saving.
  virtual void pieces(const std::string& /*name*/, std::size_t count, const Piece& piece) {
    for (std::size_t k = 0; k < count; ++k) piece(k, *this);
  }
  /// Transfers state that belongs to this rank alone and could be recomputed from the rest up to round-off.
  /// @return false if it cannot be loaded because the number of ranks has changed
  virtual bool of_rank(const std::function<void(Archive&)>& part) {
    part(*this);
    return true;
  }

  /// Transfers a number, an enumeration or a struct of such.
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
  /// Transfers a list of objects with a `transfer` member, of lists, or of texts.
  template<class T>
  requires(!std::is_trivially_copyable_v<T>) void operator()(const char* name, std::vector<T>& list) {
    std::uint64_t count = list.size();
    (*this)(name, count);
    if (loading() && count > left())
      throw std::runtime_error(std::string("the list '") + name +
                               "' is longer than what is left of the state");
    list.resize(count);
    for (T& one : list) {
      if constexpr (requires { one.transfer(*this); })
        one.transfer(*this);
      else
        (*this)(name, one);
    }
  }

  // The two operations that an archive implements; everything above calls them.
  virtual void item(const char* name, void* value, std::size_t bytes) = 0;
  virtual void array(const char* name, Sequence& values) = 0;
};

/// Transfers, of every array, only the items that belong to the points [begin, end) of `points` points, which
/// all have equally many items; single items are left out. On loading the arrays must already have their
/// lengths.
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
