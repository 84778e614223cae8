#include "limn/shadow/shadow_maps.h"

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/mapped_file.h"
#include "limn/shadow/shape_hash.h"

namespace limn {

ShadowMaps::ShadowMaps(std::string_view bytes, std::shared_ptr<const void> owner, const std::string& name)
    : bytes_(bytes), owner_(std::move(owner)), info_(decode_csm(bytes, name))
{
    const std::string_view depths = bytes.substr(csm_header_bytes);
    if (info_.codec == ShadowCodec::bricks)
        depths_ = StoredBricks(depths, info_.size, info_.grid.cells, name);
    else
        depths_ = StoredSegments(depths, info_.texels(), info_.grid.count(), name);
}

ShadowMaps read_csm(const std::filesystem::path& file)
{
    const auto mapped = std::make_shared<const MappedFile>(file);
    return {mapped->bytes(), mapped, file.string()};
}

void write_csm(const ShadowMaps& maps, const std::filesystem::path& file) { write_file(file, maps.bytes()); }

void check_shape(const ShadowMaps& maps, const Mesh& mesh, const std::string& name)
{
    if (maps.info().shape != shape_hash(mesh))
        throw Error::Read(fmt::format("{}: was baked of another mesh; bake it anew", name));
}

} // namespace limn
