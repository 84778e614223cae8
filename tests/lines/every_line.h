#pragma once

#include "limn/lines/options.h"

namespace limn::test {

/// Options that ask for every kind of line.
inline LineOptions every_line()
{
    LineOptions options;
    options.lines.clear();
    for (int i = int(LineType::highlight); i < line_type_count; ++i)
        options.lines.push_back(LineType(i));
    return options;
}

} // namespace limn::test
