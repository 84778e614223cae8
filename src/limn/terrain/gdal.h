#pragma once

// What this room's files share of GDAL: its errors and its datasets. Not for users of the library.

#include <memory>
#include <string>
#include <string_view>

#include <cpl_error.h>
#include <gdal_priv.h>

namespace limn::gdal {

/// Registers GDAL's drivers and bounds its cache of blocks to 64 MiB; the first call of a process does it.
void prepare();

/// What GDAL says on this thread while this lives; nothing of it goes to standard error.
class Reports {
public:
    Reports();
    ~Reports();
    Reports(const Reports&) = delete;
    Reports& operator=(const Reports&) = delete;

    bool failed() const { return !failure_.empty(); }
    /// The first failure since this was made or cleared, in one line, or else the first warning, or "" where GDAL said nothing.
    const std::string& cause() const { return failed() ? failure_ : warning_; }
    void clear();

private:
    static void CPL_STDCALL take(CPLErr level, CPLErrorNum number, const char* text);
    std::string failure_, warning_;
};

struct Close {
    void operator()(GDALDataset* dataset) const;
};
using Dataset = std::unique_ptr<GDALDataset, Close>;

/// Opens a raster for reading. "-" is standard input, which is read into memory.
/// @throws Error::Read naming the file and why it cannot be opened as one.
Dataset open(const std::string& file);

/// The file's name in messages.
std::string name_of(const std::string& file);

} // namespace limn::gdal
