#pragma once

#include "macro/dynamics/simulation.h"
#include "macro/output/craters.h"
#include "macro/output/projectile.h"
#include "macro/scene/scene_inputs.h"
#include "shared/summary.h"

#include <filesystem>
#include <string>
#include <variant>

namespace spall {

/// Shape of a Taylor bar now: what is measured on a recovered bar.
struct BarShape {
  double length;        ///< m
  double foot_diameter; ///< largest diameter of the impacted end, m
  double max_plastic_strain, plastic_strain_95,
      mean_plastic_strain; ///< largest, volume-weighted 95 % quantile, mean
};
BarShape measure_bar(const Solid& solid, const SceneInputs& inputs);

/// What a projectile has done to a slab so far.
struct Perforation {
  double velocity; ///< of the projectile on leaving the slab, else now, m/s; negative if it flies back
  double time;     ///< then, s
  bool perforated; ///< the tail is out of the back
  BodyMotion projectile;
  MomentumError momentum; ///< of the whole run
  double ogive_length;    ///< of the projectile, m
  double ogive_radius;    ///< m
  Fragments fragments;    ///< of the slab
  Craters craters;
};
Perforation measure_perforation(const Simulation& run, const SceneInputs& inputs, const Exit& exit,
                                const FragmentInputs& fragments);

/// What the scene is for. All ranks must call what measures and adds answers.
using Answers = std::variant<BarShape, Perforation>;
Answers measure_answers(const Simulation& run, const SceneInputs& inputs, const Exit& exit,
                        const FragmentInputs& fragments);

/// The answers by the names of the command-line contract.
void add_answers(Summary& summary, const Answers& answers, const Simulation& run, const SceneInputs& inputs);
/// The tables of a slab: fragments.csv, craters.csv, crater_profiles.csv. A bar has none.
void write_tables(const std::filesystem::path& directory, const Answers& answers);
/// The answers in one line.
std::string in_words(const Answers& answers, const SceneInputs& inputs);

} // namespace spall
