#include "shared/input/quantity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>
#include <stdexcept>

namespace spall {
namespace {

constexpr Dimension dimensions[] = {
    Dimension::none,           Dimension::length,        Dimension::time,
    Dimension::mass,           Dimension::velocity,      Dimension::stress,
    Dimension::inverse_stress, Dimension::density,       Dimension::energy_per_area,
    Dimension::rate,           Dimension::angle,         Dimension::moment_of_inertia,
    Dimension::temperature,    Dimension::specific_heat, Dimension::angular_velocity};

TEST(Quantity, TextWithUnitIsItsSiValue) {
  EXPECT_DOUBLE_EQ(parse_quantity("127 mm", Dimension::length), 0.127);
  EXPECT_DOUBLE_EQ(parse_quantity("2.5cm", Dimension::length), 0.025);
  EXPECT_DOUBLE_EQ(parse_quantity("3 um", Dimension::length), 3e-6);
  EXPECT_DOUBLE_EQ(parse_quantity("0.1 us", Dimension::time), 1e-7);
  EXPECT_DOUBLE_EQ(parse_quantity("250 g", Dimension::mass), 0.25);
  EXPECT_DOUBLE_EQ(parse_quantity("0.373 mm/us", Dimension::velocity), 373);
  EXPECT_DOUBLE_EQ(parse_quantity("-2.47 MPa", Dimension::stress), -2.47e6);
  EXPECT_DOUBLE_EQ(parse_quantity("78.6 GPa", Dimension::stress), 78.6e9);
  EXPECT_DOUBLE_EQ(parse_quantity("0.00324 1/MPa", Dimension::inverse_stress), 3.24e-9);
  EXPECT_DOUBLE_EQ(parse_quantity("2.267 g/cm3", Dimension::density), 2267);
  EXPECT_DOUBLE_EQ(parse_quantity("0.08 N/mm", Dimension::energy_per_area), 80);
  EXPECT_DOUBLE_EQ(parse_quantity(" \t1e-3 s^-1 ", Dimension::rate), 1e-3);
  EXPECT_DOUBLE_EQ(parse_quantity("180 deg", Dimension::angle), 3.141592653589793);
  EXPECT_DOUBLE_EQ(parse_quantity("60 rpm", Dimension::angular_velocity), 2 * 3.141592653589793);
  EXPECT_DOUBLE_EQ(parse_quantity("0.02 kg m2", Dimension::moment_of_inertia), 0.02);
  EXPECT_DOUBLE_EQ(parse_quantity("1793 K", Dimension::temperature), 1793);
  EXPECT_DOUBLE_EQ(parse_quantity("0.477 kJ/(kg K)", Dimension::specific_heat), 477);
  EXPECT_DOUBLE_EQ(parse_quantity("1e3", Dimension::none), 1000);
  EXPECT_DOUBLE_EQ(parse_quantity("+5 mm", Dimension::length), 0.005);
  EXPECT_DOUBLE_EQ(parse_quantity(" +.5e-3", Dimension::none), 5e-4);
}

TEST(Quantity, EveryAcceptedUnitIsAccepted) {
  for (const Dimension dimension : dimensions) {
    if (dimension == Dimension::none) continue;
    std::stringstream units(accepted_units(dimension));
    for (std::string unit; std::getline(units >> std::ws, unit, ',');)
      EXPECT_GT(parse_quantity("1 " + unit, dimension), 0) << unit;
    EXPECT_DOUBLE_EQ(parse_quantity("1 " + si_unit(dimension), dimension), 1);
  }
}

TEST(Quantity, PrintedTextParsesBackToTheSameNumber) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> exponent(-30, 30), mantissa(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    const double value = mantissa(engine) * std::pow(10, exponent(engine));
    const Dimension dimension = dimensions[i % std::size(dimensions)];
    EXPECT_EQ(parse_quantity(format_quantity(value, dimension), dimension), value);
  }
}

TEST(Quantity, RefusesWhatIsNoNumberOrHasNoUnit) {
  for (const char* text :
       {"", "  ", "mm", "1,5 mm", "nan mm", "inf mm", "1e999 mm", "12", "12 kg", "12 MM", "1 m m"})
    EXPECT_THROW(parse_quantity(text, Dimension::length), std::invalid_argument) << text;
  for (const char* text : {"0.3 mm", "x", "", "0.3 1", "+", "+-1", "-+1", "++1", "+ 1"})
    EXPECT_THROW(parse_quantity(text, Dimension::none), std::invalid_argument) << text;
}

TEST(Quantity, WholeNumbersTakeASignAndNothingElse) {
  EXPECT_EQ(parse_integer("12"), 12);
  EXPECT_EQ(parse_integer("+12 "), 12);
  EXPECT_EQ(parse_integer("-3"), -3);
  for (const char* text : {"", "+", "+-1", "2.5", "1e3", "1 m", "99999999999"})
    EXPECT_THROW(parse_integer(text), std::invalid_argument) << text;
}

TEST(Quantity, ADecimalCommaStandsBetweenDigits) {
  for (const char* text : {"0,5", "1,5 mm", "1 mm, 2,5 mm"}) EXPECT_TRUE(has_decimal_comma(text)) << text;
  for (const char* text : {"", ",", "1, 2", "1 mm,2 mm", "x,y", "1,"})
    EXPECT_FALSE(has_decimal_comma(text)) << text;
}

TEST(Quantity, RefusalNamesTheUnitsAllowed) {
  try {
    parse_quantity("12 kg", Dimension::length);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(accepted_units(Dimension::length)), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("kg"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace spall
