// Tests of the list of material laws, and of the choice of a law in a file.

#include "shared/error.h"
#include "tests/unit/material/samples.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <unistd.h>

namespace spall::test {
namespace {

namespace fs = std::filesystem;

const char* const files[] = {
    "wes5000",        "wes5000_u",     "wes5000_g3",      "aluminium_6061_t6", "steel_4340",
    "copper_ofhc_jc", "steel_4340_jc", "concrete_48_hjc", "concrete_35_rht",   "soil"};

/// The names of the list of laws.
std::set<std::string> names() {
  return std::apply([](const auto&... law) { return std::set<std::string>{law.name...}; }, Laws{});
}

/// Inputs bound to parameters, from a text or a file, with a prefix.
struct Read {
  explicit Read(std::string prefix_ = "") : prefix(std::move(prefix_)) { inputs.declare(parameters, prefix); }
  void file(const std::string& path, const std::vector<std::string>& changes = {}) {
    parameters.read(path, changes);
  }
  void text(const std::string& text, const std::vector<std::string>& changes = {}) {
    const fs::path path =
        fs::temp_directory_path() / ("spall_materials_" + std::to_string(getpid()) + ".prm");
    std::ofstream(path) << text;
    file(path, changes);
    fs::remove(path);
  }
  std::string prefix;
  MaterialInputs inputs;
  Parameters parameters;
};
std::string sample(const std::string& name) { return SPALL_DATA "/materials/" + name + ".prm"; }

/// Returns the message of the InputError that `action` throws.
template<class Action> std::string refusal(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Laws, HaveDifferentNamesAndASampleEach) {
  EXPECT_EQ(names().size(), std::tuple_size_v<Laws>);
  std::set<std::string> sampled;
  for (const char* name : files) {
    Read read;
    read.file(sample(name));
    sampled.insert(read.inputs.law());
  }
  EXPECT_EQ(sampled, names());
}

TEST(Laws, ComeBackFromTheirResolvedInputs) {
  for (const char* name : files) {
    Read first, second;
    first.file(sample(name));
    first.inputs.validate(name);
    second.text(first.parameters.resolved());
    second.inputs.validate(name);
    EXPECT_EQ(second.parameters.resolved(), first.parameters.resolved()) << name;
    EXPECT_EQ(second.inputs.law(), first.inputs.law());
    EXPECT_GT(second.inputs.density(), 1000);
  }
}

TEST(Laws, WantTheConstantsOfTheChosenOneAndOfNoOther) {
  for (const std::string& law : names())
    for (const std::string prefix : {"", "Plate "}) {
      Read read(prefix);
      const std::string message =
          refusal([&] { read.text("subsection " + prefix + "Material\nset Law = " + law + "\nend\n"); });
      EXPECT_NE(message.find("key '" + prefix + law + "/"), std::string::npos) << message;
      EXPECT_NE(message.find("must be set"), std::string::npos) << message;
    }
  Read read;
  EXPECT_NE(refusal([&] { read.text("subsection Material\nset Law = Jelly\nend\n"); }).find("AFC | J2"),
            std::string::npos);
}

TEST(Laws, AreNotAskedForByABodyThatIsNotThere) {
  MaterialInputs inputs;
  Parameters parameters;
  inputs.declare(parameters, "", Needed::never());
  parameters.read(sample("copper"), {"Material/Law=AFC"});
  EXPECT_EQ(inputs.law(), "AFC");
}

TEST(Laws, NameTheKeyWithItsPrefixWhenTheyRefuse) {
  MaterialInputs inputs(concrete("wes5000"));
  std::get<Afc>(inputs.laws).hydrostat.C9 = 0.001;
  const std::string message = refusal([&] { inputs.validate("scene.prm", "slab/"); });
  EXPECT_NE(message.find("scene.prm: key 'slab/AFC/C9': found '0.001', allowed: > C7"), std::string::npos)
      << message;
}

// Every material answers the questions of a run.
TEST(Laws, AnswerForTheChosenOne) {
  const Afc afc = concrete("wes5000");
  const J2 steel = metal("steel_4340"), soft = metal("aluminium_6061_t6"); // the aluminium does not harden
  const MaterialInputs slab(afc), casing(steel), bar(soft);
  EXPECT_EQ(slab.law(), "AFC");
  EXPECT_EQ(casing.law(), "J2");
  EXPECT_EQ(slab.density(), afc.density);
  EXPECT_EQ(casing.density(), steel.density);
  EXPECT_NEAR(casing.youngs_modulus(), steel.youngs_modulus, 1e-12 * steel.youngs_modulus);
  EXPECT_EQ(slab.strength_limit(), 516.95 * MPa);
  EXPECT_TRUE(std::isinf(MaterialInputs(concrete("wes5000", {"AFC/C5 limits=nothing"})).strength_limit()));
  EXPECT_EQ(bar.strength_limit(), soft.initial_yield);
  EXPECT_TRUE(std::isinf(casing.strength_limit())); // hardens without bound
  EXPECT_TRUE(slab.softens());
  EXPECT_FALSE(casing.softens());
  EXPECT_TRUE(casing.ductile());
  EXPECT_FALSE(slab.ductile());
  EXPECT_FALSE(MaterialInputs(std::get<JohnsonCook>(material("copper_ofhc_jc"))).softens());
  EXPECT_TRUE(MaterialInputs(std::get<JohnsonCook>(material("copper_ofhc_jc", {"Johnson-Cook/Failure=yes"})))
                  .softens());
  Read read;
  read.file(sample("wes5000"), {"AFC/Damage table=/some/table.h5"});
  EXPECT_TRUE(read.inputs.needs_spacing());
  EXPECT_EQ(read.inputs.describe(), (Description{{"damage_table", "/some/table.h5"}}));
  EXPECT_FALSE(casing.needs_spacing());
}

TEST(Readings, AsPrintedIsThePaperToTheLetter) {
  const Afc afc = concrete("wes5000", {"AFC/Readings=as printed"});
  EXPECT_EQ(afc.hydrostat.form, HydrostatForm::printed);
  EXPECT_EQ(afc.hydrostat.unloading, Unloading::elastic);
  EXPECT_EQ(afc.surface.invariant, Invariant::trace);
  EXPECT_EQ(afc.surface.bound, StrengthBound::principal_difference);
  EXPECT_EQ(afc.surface.lode_range, LodeRange::compression);
  EXPECT_EQ(afc.surface.lode_fading, 0);
  EXPECT_EQ(afc.surface.shear_damage_side, DamageSide::both);
  EXPECT_EQ(afc.surface.tensile_damage_side, DamageSide::own);
  EXPECT_EQ(afc.shear.floor, 0);
  EXPECT_EQ(afc.shear.reference, 0);
  EXPECT_EQ(afc.tensile.definition, DamageDefinition::stiffness);
  EXPECT_EQ(afc.tensile.strain, DamageStrain::total);
  EXPECT_EQ(afc.tensile.weight, DamageWeight::none);
  EXPECT_TRUE(afc.tensile.rate.is_constant());
  EXPECT_EQ(afc.cracks.opened_kept, 0);
  EXPECT_EQ(afc.cracks.dilatancy, 0);
  // Table 1 is no reading.
  EXPECT_EQ(afc.surface.C1, 501.05 * MPa);
}

TEST(Readings, OursIsTheDefault) {
  Read ours, unsaid;
  ours.file(sample("wes5000"), {"AFC/Readings=ours"});
  unsaid.file(sample("wes5000"));
  EXPECT_EQ(ours.parameters.resolved(), unsaid.parameters.resolved());
}

TEST(Readings, AKeyThatIsSetWinsWhereverItIsSet) {
  const std::string all = "include " + sample("wes5000") + "\nsubsection AFC\n";
  const auto check = [](const Read& read) {
    const Afc& afc = std::get<Afc>(read.inputs.laws);
    EXPECT_EQ(afc.surface.invariant, Invariant::mean_stress);
    EXPECT_EQ(afc.hydrostat.form, HydrostatForm::printed);
    EXPECT_NE(read.parameters.resolved().find("Invariant                     = mean stress"),
              std::string::npos)
        << read.parameters.resolved();
  };
  Read before, after, from_line, both;
  before.text(all + "set Invariant = mean stress\nset Readings = as printed\nend\n");
  after.text(all + "set Readings = as printed\nset Invariant = mean stress\nend\n");
  from_line.text(all + "set Readings = as printed\nend\n", {"AFC/Invariant=mean stress"});
  both.text(all + "end\n", {"AFC/Invariant=mean stress", "AFC/Readings=as printed"});
  for (const Read* read : {&before, &after, &from_line, &both}) check(*read);
}

} // namespace
} // namespace spall::test
