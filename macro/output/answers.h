#pragma once

#include "macro/output/exit_answer.h"
#include "macro/output/length_answer.h"
#include "macro/output/momentum_answer.h"
#include "macro/output/penetration_answer.h"

#include <array>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

namespace spall {

/// The kinds of answers. A new one is a file of its own and a word here; it needs what ExitAnswer has: name
/// and help of its key, the form of its words, a constructor that checks the bodies in them, `follow` after
/// every step, `settled`, `part_done`, `measure`, `add_to`, `write_tables`, `in_words`, `transfer`.
using AnswerKinds = std::tuple<ExitAnswer, PenetrationAnswer, LengthAnswer, MomentumAnswer>;

namespace detail {
template<class List> struct AnswerOf;
template<class... Kind> struct AnswerOf<std::tuple<Kind...>> { using Type = std::variant<Kind...>; };
} // namespace detail
using Answer = detail::AnswerOf<AnswerKinds>::Type;

/// When a run ends before its end time.
enum class Until {
  answered, ///< as soon as all its answers are there
  end_time  ///< never
};

/// The section `Answers` of a scene file: what is asked, of which bodies.
struct AnswerInputs {
  std::array<std::string, std::tuple_size_v<AnswerKinds>> texts; ///< lists of questions, by kind
  Until until = Until::answered;

  void declare(Parameters& parameters);
};

/// The answers of a run. All ranks make the same calls.
class Answers {
public:
  /// @throws InputError about a body that is not there, or whose kind does not allow the answer. `file` names
  /// the input.
  Answers(const AnswerInputs& inputs, const SceneInputs& scene, const FragmentInputs& fragments,
          const std::string& file);

  /// After every step.
  void follow(const Simulation& run);
  /// Whether nothing more is to be waited for.
  bool settled(const Simulation& run) const;
  /// Part of the way there, 0 to 1.
  double part_done(const Simulation& run) const;
  /// Shortest simulated time that the answers can take, s: without deceleration, and a bar's elastic wave
  /// forth and back.
  double shortest_time(const Simulation& run) const;

  /// At the end of the run. An answer that cannot be measured is left out, with a warning: its keys in the
  /// summary are null.
  void measure(const Simulation& run, Warnings& warnings);
  void add_to(Summary& summary, const Simulation& run) const;
  void write_tables(const std::filesystem::path& directory) const;
  std::string in_words() const; ///< one line per answer that there is

  void transfer(Archive& archive);

  /// The body that the first answer follows; the first deformable one if nothing is asked.
  const std::string& moving_body() const { return moving; }
  /// The deformable body that the first answer is about: of a shot, the target.
  const std::string& main_body() const { return main; }
  /// Bodies whose fragments belong to an answer.
  std::vector<std::string> fragmented() const;
  bool empty() const { return list.empty(); }

private:
  std::vector<Answer> list;
  std::vector<bool> measured; ///< of each answer
  Until until;
  std::string moving, main;
};

} // namespace spall
