#pragma once

#include <string>
#include <vector>

#include "command_text.h"

/// The man page of `limn` in troff.
/// @param limn  the command itself, without its subcommands
std::string man_page(const CommandText& limn, const std::vector<CommandText>& commands);
