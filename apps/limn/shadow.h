#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "limn/shadow/shadow_maps.h"
#include "subcommand.h"

Subcommand add_shadow_bake(CLI::App& shadow);
Subcommand add_shadow_show(CLI::App& shadow);
Subcommand add_shadow_check(CLI::App& shadow);

/// "128 x 32 maps of 128 x 128, 1.6 MB, 333:1 against two float layers".
std::string size_text(const limn::ShadowMaps& maps);
/// What a file holds: grid, sizes, ratios, sphere, hash.
nlohmann::ordered_json maps_json(const limn::ShadowMaps& maps);
/// The word of the command line for a value of a bake option.
std::string bake_word(const limn::ShadowMapsInfo& info, const std::string& option);
