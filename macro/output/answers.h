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

/// The kinds of answers. A new kind needs a file of its own and an entry here. It must have the members of
/// ExitAnswer: name and help of its key, the separator of its bodies, a constructor that checks the bodies in
/// them, `follow` after every step, `settled`, `complete`, `settlement`, `part_done`, `numerical_error`,
/// `measure`, `add_to`, `write_tables`, `in_words`, `transfer`.
using AnswerKinds = std::tuple<ExitAnswer, PenetrationAnswer, LengthAnswer, MomentumAnswer>;

namespace detail {
template<class List> struct AnswerOf;
template<class... Kind> struct AnswerOf<std::tuple<Kind...>> { using Type = std::variant<Kind...>; };
} // namespace detail
using Answer = detail::AnswerOf<AnswerKinds>::Type;

/// The section `Answers` of a scene file: the questions and the bodies that they are about.
struct AnswerInputs {
  std::array<std::string, std::tuple_size_v<AnswerKinds>> texts; ///< lists of questions, by kind
  Until until = Until::settled;

  void declare(Parameters& parameters);
};

/// The answers of a run. All ranks make the same calls.
class Answers {
public:
  /// @throws InputError if a body does not exist or its kind does not allow the answer. `file` names
  /// the input.
  Answers(const AnswerInputs& inputs, const SceneInputs& scene, const FragmentInputs& fragments,
          const std::string& file);

  /// Must be called after every step.
  void follow(const Simulation& run);
  /// Returns whether the run has all that the key Run/Until waits for.
  bool reached(const Simulation& run) const;
  /// Returns the estimated progress towards the answers, 0 to 1.
  double part_done(const Simulation& run) const;
  /// Returns the shortest simulated time that the answers can take, s: that of a shot without deceleration,
  /// or of an elastic wave along a bar and back.
  double shortest_time(const Simulation& run) const;

  /// At the end of the run. An answer that cannot be measured is left out, with a warning: its keys in the
  /// summary are null. So are craters and fragments of a run that has ended before they have come about.
  void measure(const Simulation& run, Warnings& warnings);
  void add_to(Summary& summary, const Simulation& run) const;
  void write_tables(const std::filesystem::path& directory) const;
  std::string in_words() const; ///< one line or more per answer that there is
  /// Returns what is known before the run of the numerical error of each answer, in lines of text.
  std::string numerical_errors(const Simulation& run) const;

  void transfer(Archive& archive);

  /// Returns the body that the first answer follows; without questions the first deformable one.
  const std::string& moving_body() const { return moving; }
  /// Returns the deformable body that the first answer is about; for a shot it is the target.
  const std::string& main_body() const { return main; }
  /// Returns the bodies whose fragments belong to an answer.
  std::vector<std::string> fragmented() const;
  /// Returns for each answer about two bodies the one that moves and its target.
  std::vector<std::pair<std::string, std::string>> shots() const;
  bool empty() const { return list.empty(); }

private:
  std::vector<Answer> list;
  std::vector<bool> measured;          ///< of each answer
  std::vector<Settlement> settlements; ///< of each answer, when it was measured
  Until until;
  std::string moving, main;
};

} // namespace spall
