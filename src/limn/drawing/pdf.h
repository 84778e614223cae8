#pragma once

#include <filesystem>
#include <string>

#include "limn/drawing/painting.h"

namespace limn {

/// A drawing as one vector page of PDF 1.5, painted as the SVG is. The date inside is fixed: same drawing, same bytes
/// (with one version of Cairo). @throws Error::Write when Cairo cannot.
std::string to_pdf(const Drawing& drawing, const Style& style = {});

/// @throws Error::Write
void write_pdf(const Drawing& drawing, const std::filesystem::path& path, const Style& style = {});

} // namespace limn
