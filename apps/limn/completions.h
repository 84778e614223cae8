#pragma once

#include <string>
#include <vector>

#include "command_text.h"

/// Scripts that teach a shell the subcommands, options and named values of `limn`.
/// @param limn  the command itself, without its subcommands
std::string bash_completions(const CommandText& limn, const std::vector<CommandText>& commands);
std::string zsh_completions(const CommandText& limn, const std::vector<CommandText>& commands);
std::string fish_completions(const CommandText& limn, const std::vector<CommandText>& commands);
