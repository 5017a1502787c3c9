// A damage table of any bytes is refused before HDF5 sees it, and one of any numbers is refused or makes a
// law that can be evaluated. The first byte chooses.

#include "shared/damage_table.h"
#include "shared/damage_law.h"
#include "tests/fuzz/as_file.h"

#include <cstring>

namespace {

/// Takes the bytes of a fuzzer as numbers, one after the other; 0 when there are no more.
class Numbers {
public:
  Numbers(const std::uint8_t* data_, std::size_t size_) : data(data_), left(size_) {}
  double next() {
    double number = 0;
    if (left < sizeof number) return 0;
    std::memcpy(&number, data, sizeof number);
    data += sizeof number, left -= sizeof number;
    return number;
  }
  bool empty() const { return left < sizeof(double); }

private:
  const std::uint8_t* data;
  std::size_t left;
};

spall::DamageTable table_of(Numbers numbers) {
  spall::DamageTable table;
  table.youngs_modulus = numbers.next();
  table.poisson_ratio = numbers.next();
  table.tensile_strength = numbers.next();
  table.fracture_energy = numbers.next();
  while (!numbers.empty() && table.curves.size() < 3) {
    spall::DamageCurve& curve = table.curves.emplace_back();
    curve.cell_size = numbers.next();
    curve.relative_strength = numbers.next();
    for (int row = 0; row < 4; ++row)
      for (const spall::DamageColumn& column : spall::damage_columns)
        (curve.*column.values).push_back(numbers.next());
  }
  return table;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  return spall::test::only_refuses([&] {
    if (data[0] % 2 == 0) {
      spall::read_damage_table(spall::test::as_file(data + 1, size - 1, ".h5"));
      return;
    }
    const spall::DamageTable table = table_of({data + 1, size - 1});
    spall::check(table, "table");
    spall::check_tension(table, "table");
  });
}
