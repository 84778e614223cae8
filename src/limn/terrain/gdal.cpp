#include "limn/terrain/gdal.h"

#include <cerrno>
#include <cpl_multiproc.h>
#include <cstring>
#include <unistd.h>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/terrain/ascii_grid.h"

namespace limn::gdal {
namespace {

constexpr GIntBig cache_bytes = GIntBig(64) << 20;
constexpr const char* in_memory = "/vsimem/limn-";

std::string one_line(std::string_view text)
{
    std::string line;
    for (const char c : text) {
        const bool space = c == '\n' || c == '\r' || c == '\t' || c == ' ';
        if (!space)
            line += c;
        else if (!line.empty() && line.back() != ' ')
            line += ' ';
    }
    while (!line.empty() && (line.back() == ' ' || line.back() == '.'))
        line.pop_back();
    return line;
}

/// Standard input as a file that GDAL can seek in; it goes with the dataset (Close).
std::string standard_input_in_memory()
{
    const std::string bytes = read_file("-");
    if (bytes.empty())
        throw Error::Read("standard input: is empty");
    auto* copy = static_cast<GByte*>(VSIMalloc(bytes.size()));
    if (!copy)
        throw std::bad_alloc();
    std::memcpy(copy, bytes.data(), bytes.size());
    const std::string path = fmt::format("{}{}", in_memory, static_cast<void*>(copy));
    VSIFCloseL(VSIFileFromMemBuffer(path.c_str(), copy, bytes.size(), TRUE));
    return path;
}

/// Says what is wrong with a file before GDAL is asked, whose own words for it are vague.
void check_file(const std::string& path)
{
    VSIStatBufL info;
    if (VSIStatL(path.c_str(), &info) != 0 || (!path.starts_with("/vsi") && ::access(path.c_str(), R_OK) != 0))
        throw Error::Read(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno != 0 ? errno : ENOENT)));
    if (!VSI_ISDIR(info.st_mode) && info.st_size == 0)
        throw Error::Read(fmt::format("{}: is empty", path));
}

/// GDAL with all its formats. What it keeps for the main thread goes at the end; of other threads it does that itself.
class Library {
public:
    Library()
    {
        GDALAllRegister();
        GDALSetCacheMax64(cache_bytes);
    }
    ~Library() { CPLCleanupTLS(); }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
};

} // namespace

void prepare() { [[maybe_unused]] static const Library library; }

Reports::Reports() { CPLPushErrorHandlerEx(take, this); }

Reports::~Reports() { CPLPopErrorHandler(); }

void Reports::clear()
{
    failure_.clear();
    warning_.clear();
}

void CPL_STDCALL Reports::take(CPLErr level, CPLErrorNum, const char* text)
{
    auto* reports = static_cast<Reports*>(CPLGetErrorHandlerUserData());
    std::string* const kept = level >= CE_Failure ? &reports->failure_ : level == CE_Warning ? &reports->warning_ : nullptr;
    if (kept && kept->empty())
        *kept = one_line(text);
}

void Close::operator()(GDALDataset* dataset) const
{
    const Reports quiet;
    const std::string path = dataset->GetDescription();
    GDALClose(dataset);
    if (path.starts_with(in_memory))
        VSIUnlink(path.c_str());
}

Dataset open(const std::string& file)
{
    prepare();
    const Reports reports;
    const std::string path = file == "-" ? standard_input_in_memory() : file;
    if (file != "-")
        check_file(path);
    constexpr unsigned flags = GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR;
    Dataset dataset(GDALDataset::Open(path.c_str(), flags));
    if (dataset && dataset->GetDriver() && std::string_view(dataset->GetDriver()->GetDescription()) == "AAIGrid") {
        check_ascii_grid(path, name_of(file));
        const char* const whole_range[] = {"DATATYPE=Float64", nullptr}; // it takes the first heights' word for all, and nan for 0 in whole numbers
        dataset.release()->Release();
        dataset.reset(GDALDataset::Open(path.c_str(), flags, nullptr, whole_range));
    }
    if (dataset)
        return dataset;
    if (file == "-")
        VSIUnlink(path.c_str());
    const bool unknown = reports.cause().empty() || reports.cause().find("not recognized as a supported file format") != std::string::npos;
    throw Error::Read(fmt::format("{}: is no raster that GDAL knows{}", name_of(file), unknown ? "" : ": " + reports.cause()));
}

std::string name_of(const std::string& file) { return file == "-" ? "standard input" : file; }

} // namespace limn::gdal
