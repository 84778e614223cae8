#pragma once

// The file that 'limn terrain build' writes and TerrainPyramid reads. Not for users of the library.
//
// All numbers are little-endian; u32 and u64 are unsigned, f32 and f64 IEEE floats. Heights are metres; NaN: no data.
//
// Header, 112 bytes:
//
//   at  type    what
//    0  8 bytes "LIMNPYR\n"
//    8  u32     version: 1
//   12  u32     CRC-32 (as in PNG and zip) of the header from byte 16 on, and of the directory
//   16  u64     length of the file in bytes
//   24  u32     columns of the map
//   28  u32     rows
//   32  u32     level of the lattice: its root squares have 2^level cells (lattice.h)
//   36  u32     tile level: tiles have 2^that cells along each side (pyramid_layout.h)
//   40  f64 x 2 spacing between columns and rows, in metres
//   56  f64 x 2 place of the south-western sample in the map's system: easting and northing, or degrees
//   72  f32     lowest sample
//   76  f32     highest sample
//   80  u64     samples with data
//   88  u32     bytes of the system's name
//   92  u32     1 where the directory holds the last column and row, else 0
//   96  u64     bytes of the directory
//  104  u64     0
//
// Directory, from byte 112 on:
//
//   32 bytes for each tile, the coarsest level first, row by row:
//        0  u64  where the tile is in the file
//        8  u32  its bytes; 0 where it has no data
//       12  u32  their CRC-32
//       16  f32  the greatest error of the points that the tile owns (nested_errors.h), in metres, rounded up; infinite beside missing data
//       20  f32  their lowest height, and
//       24  f32  their highest one, in all that depends on them; infinite and minus infinite where there is none
//       28  u32  0
//   f32 for each row: the last column; f32 for each column: the last row. Where triangles reach beyond the map, these are the corners that
//        cutting makes.
//   the system's name, UTF-8
//
// Tiles follow in the order in which they were made. Each is one Zstandard frame, with n = 2^tile level + 1 points along each side, of:
//
//   (n + 2)^2 heights, row by row, of the points and one more around them (NaN outside the map), as 32-bit words: the bits of the float, minus
//        those of its western neighbour, minus those of its northern one, plus those of its north-western one (0 where there is none), modulo
//        2^32. First the lowest bytes of all words, then the next ones, and so on.
//   above level 0, of the n^2 points: their errors' bits; the height's bits minus those of the lowest height below; the bits of the highest
//        height below minus the height's. Bytes in the same order. All zero at points of another level. (Level 0: they follow from the heights.)

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "limn/terrain/nested_errors.h"
#include "limn/terrain/pyramid_layout.h"

namespace limn {

/// Where a tile is in its file, and what decides whether anything in it can matter.
struct TileEntry {
    std::uint64_t offset = 0;
    std::uint32_t size = 0, checksum = 0;
    PointBounds bounds = {}; ///< around all points that it owns
};

/// Everything in a pyramid's file but its tiles.
struct PyramidDirectory {
    HeightMap frame; ///< without heights
    int lattice_level = 0, tile_level = 0;
    float low = 0, high = 0;
    std::uint64_t samples = 0, file_bytes = 0;
    std::vector<TileEntry> tiles;
    std::vector<float> last_column, last_row; ///< empty where no triangle reaches beyond the map
};

constexpr std::size_t pyramid_header_bytes = 112;

/// The length of header and directory.
std::size_t directory_bytes(const PyramidDirectory& directory);
/// Both as the file begins.
std::string encode_directory(const PyramidDirectory& directory);

/// What the header tells of the directory's length.
/// @param header      the file's first bytes, pyramid_header_bytes of them or all there are
/// @param file_bytes  the file's length as it is
/// @throws Error::Read naming `name` and the fault
std::size_t check_pyramid_header(std::string_view header, std::uint64_t file_bytes, const std::string& name);
/// @param bytes  header and directory, of the length that check_pyramid_header() told
/// @throws Error::Read naming `name` and the fault
PyramidDirectory decode_directory(std::string_view bytes, const std::string& name);

/// Whether a file's first bytes are a pyramid's.
bool is_pyramid(std::string_view bytes);

std::uint32_t checksum_of(std::string_view bytes);

} // namespace limn
