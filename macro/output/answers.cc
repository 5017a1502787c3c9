#include "macro/output/answers.h"

#include "macro/scene/names.h"
#include "shared/error.h"
#include "shared/input/words.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace spall {
namespace {

/// Calls visit<Kind>(place) for every kind of answer.
template<class Visit> void for_each_kind(const Visit& visit) {
  [&]<std::size_t... k>(std::index_sequence<k...>) {
    (visit.template operator()<std::tuple_element_t<k, AnswerKinds>>(k), ...);
  }
  (std::make_index_sequence<std::tuple_size_v<AnswerKinds>>());
}

/// Returns the bodies that a question names: one, or two that are separated by a word.
template<class Kind>
std::vector<std::string> bodies_of(const std::string& question, const std::string& file) {
  const std::string separator = Kind::separator;
  if (separator.empty()) return {question};
  const std::size_t at = question.find(separator);
  const std::string one = trimmed(question.substr(0, at)),
                    other = at == std::string::npos ? "" : trimmed(question.substr(at + separator.size()));
  if (one.empty() || other.empty())
    throw InputError(file + ": key 'Answers/" + Kind::name + "': found '" + question + "', allowed: 'BODY" +
                     separator + "BODY'");
  return {one, other};
}

/// The questions of one kind. @throws InputError
std::vector<std::string> questions_of(const std::string& text, const char* key, const std::string& file) {
  try {
    return list_of(text);
  } catch (const std::invalid_argument& error) {
    throw InputError(file + ": key 'Answers/" + key + "': found '" + text +
                     "', allowed: names between commas, each once (" + error.what() + ")");
  }
}

} // namespace

void AnswerInputs::declare(Parameters& parameters) {
  auto section = parameters.section("Answers");
  for_each_kind([&]<class Kind>(std::size_t k) { section.text(Kind::name, texts[k], Kind::help); });
  parameters.section("Run").choice(
      "Until", until,
      {{"settled", Until::settled}, {"answered", Until::answered}, {"end time", Until::end_time}},
      "end of the run: settled: as soon as the velocities, depths and lengths that section Answers asks for "
      "do not change any more; answered: later, when projectiles have left their targets with their tails, "
      "so that craters and fragments are reported too; end time: only at Time/End time");
}

Answers::Answers(const AnswerInputs& inputs, const SceneInputs& scene, const FragmentInputs& fragments,
                 const std::string& file)
    : until(inputs.until) {
  for_each_kind([&]<class Kind>(std::size_t k) {
    for (const std::string& question : questions_of(inputs.texts[k], Kind::name, file))
      list.push_back(Kind(bodies_of<Kind>(question, file), scene, fragments, file));
  });
  moving = main = scene.contact_order().front();
  measured.assign(list.size(), false);
  if (list.empty()) return;
  std::visit([this](const auto& first) { moving = first.moving(), main = first.main(); }, list.front());
}

void Answers::follow(const Simulation& run) {
  for (Answer& answer : list) std::visit([&](auto& a) { a.follow(run); }, answer);
}

bool Answers::reached(const Simulation& run) const {
  if (until == Until::end_time || list.empty()) return false;
  return std::all_of(list.begin(), list.end(), [&](const Answer& answer) {
    return std::visit(
        [&](const auto& a) { return until == Until::settled ? a.settled(run) : a.complete(run); }, answer);
  });
}

double Answers::part_done(const Simulation& run) const {
  if (until == Until::end_time || list.empty()) return 0;
  double least = 1;
  for (const Answer& answer : list)
    least = std::min(least, std::visit([&](const auto& a) { return a.part_done(run, until); }, answer));
  return least;
}

double Answers::shortest_time(const Simulation& run) const {
  double longest = 0;
  for (const Answer& answer : list)
    longest =
        std::max(longest, std::visit([&](const auto& a) { return a.shortest_time(run, until); }, answer));
  return longest;
}

void Answers::measure(const Simulation& run, Warnings& warnings) {
  measured.clear();
  settlements.clear();
  const bool early = until == Until::settled && reached(run);
  for (Answer& answer : list)
    std::visit(
        [&](auto& a) {
          measured.push_back(evaluate(
              std::string("Answers/") + a.name + " of the " + a.moving(),
              [&] { a.measure(run, warnings, !early || a.complete(run)); }, warnings, run.ranks()));
          settlements.push_back(a.settlement(run));
        },
        answer);
}

namespace {

/// Returns the prefix of an answer's names: empty for the first answer, the names of the bodies for others.
std::string prefix_of(const Answer& answer, bool first) {
  if (first) return "";
  return std::visit(
      [](const auto& a) {
        return key_of(a.moving()) + "_" + (a.main() == a.moving() ? "" : key_of(a.main()) + "_");
      },
      answer);
}

/// Which bodies have perforated a target, and when the first of them broke through its back.
struct Perforation {
  std::string by;
  double time = std::nan("");
};

/// Returns what the answers say of each target, in the order in which they are asked about.
std::vector<std::pair<std::string, Perforation>> perforations(const std::vector<Answer>& list) {
  std::vector<std::pair<std::string, Perforation>> found;
  const auto of = [&](const std::string& target) -> Perforation& {
    for (auto& [name, perforation] : found)
      if (name == target) return perforation;
    return found.emplace_back(target, Perforation{}).second;
  };
  for (const Answer& answer : list)
    std::visit(
        [&](const auto& a) {
          if constexpr (requires { a.shot_of(); }) {
            const Shot& shot = a.shot_of();
            Perforation& target = of(shot.target);
            if (a.outcome() != Outcome::perforated) return;
            if ((", " + target.by + ", ").find(", " + shot.body + ", ") == std::string::npos)
              target.by += (target.by.empty() ? "" : ", ") + shot.body;
            target.time = std::fmin(target.time, shot.break_through);
          }
        },
        answer);
  return found;
}

} // namespace

void Answers::add_to(Summary& summary, const Simulation& run) const {
  for (std::size_t i = 0; i < list.size(); ++i) {
    Summary answer;
    std::visit([&](const auto& a) { a.add_to(answer, run, prefix_of(list[i], i == 0)); }, list[i]);
    settlements.at(i).add_to(answer, prefix_of(list[i], i == 0));
    if (!measured.at(i)) answer.forget_values();
    summary.add(answer);
  }
  for (const auto& [target, perforation] : perforations(list)) {
    summary.set(key_of(target) + "_perforated", !perforation.by.empty());
    summary.set(key_of(target) + "_perforated_by", perforation.by);
    summary.set(key_of(target) + "_perforated_at", perforation.time);
  }
}

void Answers::write_tables(const std::filesystem::path& directory) const {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (measured.at(i))
      std::visit([&](const auto& a) { a.write_tables(directory, prefix_of(list[i], i == 0)); }, list[i]);
}

std::string Answers::in_words() const {
  std::string words;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (measured.at(i))
      words += (words.empty() ? "" : "\n") + std::visit([](const auto& a) { return a.in_words(); }, list[i]) +
               "\n" + settlements.at(i).in_words();
  return words;
}

std::string Answers::numerical_errors(const Simulation& run) const {
  std::string words;
  for (const Answer& answer : list)
    std::visit(
        [&](const auto& a) {
          const std::optional<NumericalError> error = a.numerical_error(run);
          if (!error) return;
          const std::string other = a.main() == a.moving() ? "" : a.separator + a.main();
          words += "numerical error" + (list.size() > 1 ? ", " + a.moving() + other : "") + ": " +
                   error->in_words(a.moving()) + "\n";
        },
        answer);
  return words;
}

std::vector<std::string> Answers::fragmented() const {
  std::vector<std::string> names;
  for (const Answer& answer : list)
    std::visit(
        [&](const auto& a) {
          if (a.has_fragments() && std::find(names.begin(), names.end(), a.main()) == names.end())
            names.push_back(a.main());
        },
        answer);
  return names;
}

std::vector<std::pair<std::string, std::string>> Answers::shots() const {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const Answer& answer : list)
    std::visit(
        [&](const auto& a) {
          if (a.moving() != a.main()) pairs.emplace_back(a.moving(), a.main());
        },
        answer);
  return pairs;
}

void Answers::transfer(Archive& archive) {
  for (Answer& answer : list) std::visit([&](auto& a) { a.transfer(archive); }, answer);
}

} // namespace spall
