#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace spall {

// A seal is a checksum of a whole file at its end. It finds damaged and cut files before a library reads
// them: HDF5 itself does not notice changed bytes, and some of them make it crash. HDF5 does not look behind
// the end of its own contents, so that sealed files stay files that other programs read; one that writes into
// them takes the seal off. It finds damage, no forgery.
//
// Layout, in the byte order of the machine (little): contents; the parts that the checksum leaves out, as
// pairs of first byte and count; their number; the size of the contents; the CRC-32 (zlib) of all this, as 8
// bytes; "SPALLCRC".

/// Bytes [first, first + count) of a file.
struct ByteRange {
  std::uint64_t first, count;
};

/// Bytes of a seal at most, for a file of some lists of pieces.
inline constexpr std::size_t room_of_seal = 4096;

/// Writes the seal behind a file that is closed. @param apart parts with checksums of their own, which are
/// not read, in ascending order. @throws std::runtime_error with the reason
void seal(const std::filesystem::path& file, const std::vector<ByteRange>& apart = {});

/// @throws std::runtime_error with what is wrong with a file: no seal, or other contents than were sealed
void check_seal(const std::filesystem::path& file);

/// A line for each file: its name and the checksum of all its bytes, or that it has none because it is not
/// there.
/// @throws std::runtime_error if one cannot be read to its end
std::string checksums_of(const std::vector<std::filesystem::path>& files);

} // namespace spall
