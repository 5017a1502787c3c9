#pragma once

#include "macro/solid/solid_of.h"

namespace spall {

template<class Material, class T, class Stress> void SolidOf<Material, T, Stress>::resize(std::size_t count) {
  points.resize(count);
  stresses = Stress(count, inputs.integration);
  make_blocks();
}

template<class Material, class T, class Stress>
void SolidOf<Material, T, Stress>::transfer(Archive& archive) {
  const Ranks& ranks = ghosts.processes();
  std::vector<std::uint64_t> shares =
      next_shares.empty() ? ranks.join(std::vector<std::uint64_t>{points.owned}) : next_shares;
  archive("shares_of_ranks", shares);
  if (archive.loading() && shares.size() == static_cast<std::size_t>(ranks.count()))
    if (const std::uint64_t then = shares[static_cast<std::size_t>(ranks.rank())]; then != points.owned)
      resize(then);
  archive("built", built);
  std::vector<PointNames> names(archive.loading() ? blocks.size() : 0);
  const std::vector<std::uint64_t> numbers =
      archive.loading() ? std::vector<std::uint64_t>{} : ghosts.numbers(points);
  archive.pieces(label + "_blocks", blocks.size(), [&](std::size_t b, Archive& piece) {
    if (piece.loading()) return transfer(blocks[b], names[b], piece);
    PointNames of_block = ghosts.names(points, numbers, blocks[b].operators.stencil);
    transfer(blocks[b], of_block, piece);
  });
  const bool known = archive.of_rank([&](Archive& part) { ghosts.transfer(part, points.owned); });
  if (archive.loading() && built) connect(names, known);
}

template<class Material, class T, class Stress>
void SolidOf<Material, T, Stress>::transfer(Block& block, PointNames& names, Archive& archive) {
  Slice part(archive, block.operators.begin, block.operators.end, points.owned);
  points.transfer(part);
  stresses.transfer(part);
  names.transfer(archive);
  block.operators.transfer(archive);
  archive("block_change", block.change);
  archive("block_skipped", block.skipped);
  archive("block_stable_step", block.stable_step);
  archive("block_ratio", block.ratio);
}

template<class Material, class T, class Stress>
void SolidOf<Material, T, Stress>::connect(const std::vector<PointNames>& names, bool ghosts_known) {
  if (ghosts_known) {
    for (VectorField* field : {&points.position, &points.velocity, &points.force})
      field->resize(points.owned + ghosts.size());
    ghosts.refresh(points);
  } else {
    ghosts.rebuild(points, names);
  }
  const std::vector<std::vector<std::uint32_t>> places = ghosts.places(points, names);
  for (std::size_t b = 0; b < blocks.size(); ++b) blocks[b].operators.relocate(places[b]);
  connect_blocks();
}

} // namespace spall
