#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

/// A program of bench/peers that measures another library and prints JSON. It is built only where asked for (-DLIMN_BENCH=ON
/// -DLIMN_PEERS=ON), and found in the folder `bench` beside this program, as in a build folder, or among the installed programs (PATH).
/// @return its command, quoted for a shell; nothing where it is not found
std::optional<std::string> find_peer(const std::string& name);

/// Runs a peer. @throws limn::Error::Device where it prints no JSON
nlohmann::json result_of_peer(const std::string& command, const std::string& arguments);
