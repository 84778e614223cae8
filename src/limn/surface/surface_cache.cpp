#include "limn/surface/surface_cache.h"

#include <cstring>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file.h"

namespace limn {
namespace {

// Goes up with every change of the file's layout or of what an estimator computes.
constexpr std::uint64_t version = 1;

/// A 64-bit hash of what it was given, in order (multiply and fold, after the finaliser of MurmurHash3).
class Hash {
public:
    void add(std::uint64_t word)
    {
        state_ = (state_ ^ word) * 0xff51afd7ed558ccdull;
        state_ ^= state_ >> 33;
    }
    template <class T> void add(std::span<const T> values)
    {
        const auto bytes = std::as_bytes(values);
        add(bytes.size());
        for (std::size_t at = 0; at < bytes.size(); at += 8) {
            std::uint64_t word = 0;
            std::memcpy(&word, bytes.data() + at, std::min<std::size_t>(8, bytes.size() - at));
            add(word);
        }
    }
    std::uint64_t value() const { return state_; }

private:
    std::uint64_t state_ = 0x9e3779b97f4a7c15ull;
};

std::uint64_t hash_of(const Mesh& mesh, const EstimateOptions& options)
{
    Hash hash;
    hash.add(version);
    hash.add(std::span(mesh.positions));
    hash.add(std::span(mesh.triangles));
    for (const int value : {int(options.need), int(options.method), options.radius, options.smooth})
        hash.add(std::uint64_t(value));
    return hash.value();
}

/// Calls `f` for each array of a surface.
template <class S, class F> void each_array(S& surface, F&& f)
{
    f(surface.normals);
    f(surface.e1);
    f(surface.e2);
    f(surface.k1);
    f(surface.k2);
    f(surface.derivative);
    f(surface.unreliable);
}

std::uint64_t checksum(const Surface& surface)
{
    Hash hash;
    each_array(surface, [&](const auto& array) { hash.add(std::span(array)); });
    return hash.value();
}

void append(std::string& bytes, const void* data, std::size_t size)
{
    bytes.append(static_cast<const char*>(data), size);
}

/// The key and the checksum, then each array: its length and its bytes.
std::string to_bytes(const Surface& surface, std::uint64_t key)
{
    std::string bytes;
    const std::uint64_t head[] = {key, checksum(surface)};
    append(bytes, head, sizeof head);
    each_array(surface, [&](const auto& array) {
        const std::uint64_t count = array.size();
        append(bytes, &count, sizeof count);
        append(bytes, array.data(), array.size() * sizeof array[0]);
    });
    return bytes;
}

/// Takes the first bytes off; false when there are too few.
bool take(std::string_view& bytes, void* data, std::size_t size)
{
    if (bytes.size() < size)
        return false;
    std::memcpy(data, bytes.data(), size);
    bytes.remove_prefix(size);
    return true;
}

template <class T> bool take_array(std::string_view& bytes, std::vector<T>& array, std::size_t vertices)
{
    std::uint64_t count = 0;
    if (!take(bytes, &count, sizeof count) || (count != 0 && count != vertices) || bytes.size() / sizeof(T) < count)
        return false;
    array.resize(count);
    return take(bytes, array.data(), count * sizeof(T));
}

std::optional<Surface> from_bytes(std::string_view bytes, std::uint64_t key, std::size_t vertices)
{
    std::uint64_t head[2] = {};
    if (!take(bytes, head, sizeof head) || head[0] != key)
        return std::nullopt;
    Surface surface;
    bool whole = true;
    each_array(surface, [&](auto& array) { whole = whole && take_array(bytes, array, vertices); });
    if (!whole || !bytes.empty() || checksum(surface) != head[1])
        return std::nullopt;
    return surface;
}

std::optional<Surface> find(const std::filesystem::path& file, std::uint64_t key, std::size_t vertices)
{
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored))
        return std::nullopt;
    try {
        return from_bytes(read_file(file), key, vertices);
    } catch (const Error::Read&) { // unreadable is as good as missing
        return std::nullopt;
    }
}

} // namespace

CachedSurface estimate_surface_cached(const Mesh& mesh, const EstimateOptions& options, const std::filesystem::path& folder,
                                      EstimateReport* report, const VertexFaces* around)
{
    const std::uint64_t key = hash_of(mesh, options);
    const std::filesystem::path file = folder / fmt::format("{:016x}.limn-surface", key);
    if (std::optional<Surface> found = find(file, key, mesh.positions.size()))
        return {std::move(*found), true};
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure)
        throw Error::Write(fmt::format("{}: cannot be made: {}", folder.string(), failure.message()));
    CachedSurface estimated = {estimate_surface(mesh, options, report, around), false};
    write_file(file, to_bytes(estimated.surface, key));
    return estimated;
}

} // namespace limn
