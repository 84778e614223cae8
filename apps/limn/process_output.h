#pragma once

#include <string>

/// What a shell command writes to its standard output; empty where it cannot be run.
std::string output_of(const std::string& command);
