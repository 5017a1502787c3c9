#include "macro/output/whole_body.h"

#include <cstring>

namespace spall {
namespace {

/// Keeps the parts of a state one by one, in the order of their transfer.
class Collector final : public Archive {
public:
  bool loading() const override { return false; }
  std::vector<std::vector<char>> parts;

protected:
  void item(const char*, void* value, std::size_t count) override { put(value, count); }
  void array(const char*, Sequence& values) override { put(values.data(), values.bytes()); }

private:
  void put(const void* data, std::size_t count) {
    const auto* bytes = static_cast<const char*>(data);
    parts.emplace_back(bytes, bytes + count);
  }
};

/// Gives them back.
class Distributor final : public Archive {
public:
  explicit Distributor(const std::vector<std::vector<char>>& parts_) : parts(parts_) {}
  bool loading() const override { return true; }

protected:
  void item(const char*, void* value, std::size_t count) override {
    std::memcpy(value, parts[next++].data(), count);
  }
  void array(const char*, Sequence& values) override {
    const std::vector<char>& bytes = parts[next++];
    values.resize(bytes.size() / values.item_bytes);
    if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  }

private:
  const std::vector<std::vector<char>>& parts;
  std::size_t next = 0;
};

/// What the points of a solid are and remember, without ghosts.
std::vector<std::vector<char>> own_points(Solid& solid) {
  Points points = solid.points;
  for (VectorField* field : {&points.position, &points.velocity, &points.force}) field->resize(points.owned);
  Collector collector;
  points.transfer(collector);
  solid.transfer_states(collector);
  return std::move(collector.parts);
}

} // namespace

WholeBody::WholeBody(Simulation& spread_, const std::function<Simulation()>& make) : spread(spread_) {
  if (spread.ranks().several() && spread.ranks().first()) copy = std::make_unique<Simulation>(make());
}

void WholeBody::gather() {
  const Ranks& ranks = spread.ranks();
  if (!ranks.several()) return;
  for (std::size_t s = 0; s < spread.solids.size(); ++s) {
    std::vector<std::vector<char>> parts = own_points(*spread.solids[s]);
    for (auto& part : parts) part = ranks.join_on_first(part);
    if (!copy) continue;
    Solid& solid = *copy->solids[s];
    Distributor distributor(parts);
    solid.points.transfer(distributor);
    solid.points.owned = solid.points.mass.size();
    solid.transfer_states(distributor);
    for (VectorField* field : {&solid.points.position, &solid.points.velocity, &solid.points.force})
      field->resize(solid.points.owned + solid.ghosts.size());
    solid.ghosts.refresh(solid.points);
  }
  if (!copy) return;
  Collector collector;
  spread.transfer_record(collector);
  Distributor distributor(collector.parts);
  copy->transfer_record(distributor);
  if (copy->steps > 0)
    for (const auto& solid : copy->solids) solid->refresh();
}

} // namespace spall
