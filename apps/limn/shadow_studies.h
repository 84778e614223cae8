#pragma once

#include <string>
#include <vector>

#include "bench_table.h"
#include "limn/shadow/bake_shadow_maps.h"
#include "limn/shadow/caster_rays.h"

/// An object of the studies of shadow maps (the coherent shadow map specification, section 7).
struct ShadowSubject {
    std::string name;
    limn::Mesh mesh;
};

/// A shape of `limn sample`, of about so many triangles where it may have any number, or a file. @throws limn::Error::Input, limn::Error::Read
ShadowSubject shadow_subject(const std::string& name, std::size_t triangles = 40000);
/// The shapes that are generated, and the bunny where its package is installed.
std::vector<std::string> shadow_subject_names();

/// The seed's codec on a square grid, theta zigzag, without a margin.
limn::BakeOptions seed_options(int maps, int resolution);

/// Checklist 11, 12 and 25: sizes, ratios against two layers of floats, and errors on the object, of the seed's codec and of bricks.
void add_sizes(const ShadowSubject& subject, const std::vector<int>& maps, int resolution, MarkdownTable& table);
/// Checklist 13: sizes by order.
void add_orders(const ShadowSubject& subject, int maps, int resolution, MarkdownTable& table);
/// Checklist 12: ratios by resolution and number of maps.
void add_resolutions(const ShadowSubject& subject, const std::vector<int>& maps, const std::vector<int>& resolutions, MarkdownTable& table);
/// Checklist 14: sizes and errors of the grids of directions.
void add_spreads(const ShadowSubject& subject, const std::vector<int>& maps, int resolution, MarkdownTable& table);
/// Checklist 14: the same with the sphere's poles on each axis, and turned over.
void add_orientations(const ShadowSubject& subject, int maps, int resolution, MarkdownTable& table);
/// Checklist 15 to 19: the seed's other compressors. @param maps  a power of 4
void add_compressors(const ShadowSubject& subject, int maps, int resolution, MarkdownTable& table);
/// Checklist 27: nanoseconds of processor time for each look-up, in one thread, beside rays; the places are those of the error's pictures, shuffled.
void add_look_ups(const ShadowSubject& subject, const std::vector<int>& maps, int resolution, MarkdownTable& table);
/// Checklist 25: errors on the object and sizes by number of maps and resolution; and the smallest file on the plateau.
void add_qualities(const ShadowSubject& subject, const std::vector<int>& maps, const std::vector<int>& resolutions, MarkdownTable& table, MarkdownTable& smallest);
/// Errors on a floor beside those of the seed's codec in as many bytes, looked up its way and ours.
void add_floors(const ShadowSubject& subject, int maps, int resolution, MarkdownTable& table);
