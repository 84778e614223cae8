#include "limn/geometry/gltf_claims.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "limn/base/error.h"

namespace limn {
namespace {

using nlohmann::json;

constexpr int deepest = 100;

class GltfClaims {
public:
    GltfClaims(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

    void check(bool binary)
    {
        const std::string_view text = binary ? json_chunk() : bytes_;
        json_at_ = std::size_t(text.data() - bytes_.data());
        const json document = parse(text);
        if (!document.is_object())
            fail(fmt::format("byte {}: its JSON is no object", json_at_));
        for (const json& buffer : list(document, "buffers"))
            check_buffer(buffer);
        for (const json& view : list(document, "bufferViews"))
            check_view(view);
        for (const json& accessor : list(document, "accessors"))
            check_accessor(accessor);
    }

private:
    [[noreturn]] void fail(const std::string& what) const { throw Error::Read(fmt::format("{}: {}", name_, what)); }

    std::uint32_t u32(std::size_t at) const
    {
        if (at + 4 > bytes_.size())
            fail(fmt::format("byte {}: the file ends inside a glTF header", bytes_.size()));
        std::uint32_t value = 0;
        for (std::size_t k = 4; k-- > 0;)
            value = value << 8 | static_cast<unsigned char>(bytes_[at + k]);
        return value;
    }

    /// The JSON chunk of a .glb; remembers how long the chunk of bytes behind it is.
    std::string_view json_chunk()
    {
        if (!bytes_.starts_with("glTF"))
            fail("byte 0: found no 'glTF', with which a .glb begins");
        if (u32(4) != 2)
            fail(fmt::format("byte 4: glTF version {} where 2 is expected", u32(4)));
        if (u32(8) > bytes_.size())
            fail(fmt::format("byte 8: the header claims {} bytes, but the file has {}", u32(8), bytes_.size()));
        const std::size_t length = u32(12), end = 20 + length;
        if (u32(16) != 0x4e4f534a || end > bytes_.size())
            fail(fmt::format("byte 12: expected a chunk of JSON, and {} bytes of it", length));
        if (end < bytes_.size()) {
            binary_ = u32(end);
            u32(end + 4);
            if (binary_ > bytes_.size() - end - 8)
                fail(fmt::format("byte {}: a chunk claims {} bytes, but {} are left", end, binary_, bytes_.size() - end - 8));
        }
        return bytes_.substr(20, length);
    }

    json parse(std::string_view text) const
    {
        bool too_deep = false;
        const auto watch = [&](int depth, json::parse_event_t, json&) { return !(too_deep = too_deep || depth > deepest); };
        try {
            const json document = json::parse(text.begin(), text.end(), watch);
            if (too_deep)
                fail(fmt::format("byte {}: its JSON is nested more than {} deep", json_at_, deepest));
            return document;
        } catch (const json::parse_error& error) { // which counts the bytes it has read
            fail(fmt::format("byte {}: its JSON is malformed", json_at_ + error.byte - std::min<std::size_t>(error.byte, 1)));
        }
    }

    const json& list(const json& document, const char* key) const
    {
        static const json empty = json::array();
        const auto found = document.find(key);
        if (found == document.end())
            return empty;
        if (!found->is_array())
            fail(fmt::format("byte {}: '{}' of its JSON is no list", json_at_, key));
        return *found;
    }

    /// A whole number of at most 2^40, or `otherwise` where the key is missing.
    /// @param who  whose it is: "accessor 3"
    std::size_t number(const json& object, const std::string& who, const char* key, std::size_t otherwise) const
    {
        if (!object.is_object())
            fail(fmt::format("{}: found a value where an object is expected", who));
        const auto found = object.find(key);
        if (found == object.end())
            return otherwise;
        if (!found->is_number_unsigned() || found->get<std::uint64_t>() > std::uint64_t(1) << 40)
            fail(fmt::format("{}: '{}' is {}, which is no size", who, key, found->dump().substr(0, 40)));
        return found->get<std::size_t>();
    }

    void check_buffer(const json& buffer)
    {
        const std::size_t length = number(buffer, fmt::format("buffer {}", buffers_.size()), "byteLength", 0);
        const auto uri = buffer.find("uri");
        // Base64 holds 3 bytes in 4 characters. What another file holds is not known here.
        const bool inside = uri == buffer.end() || (uri->is_string() && uri->get_ref<const std::string&>().starts_with("data:"));
        const std::size_t held = uri == buffer.end() ? binary_ : bytes_.size() / 4 * 3;
        if (inside && length > held)
            fail(fmt::format("buffer {} claims {} bytes, but {} are there", buffers_.size(), length, held));
        buffers_.push_back(length);
    }

    void check_view(const json& view)
    {
        const std::string who = fmt::format("buffer view {}", views_.size());
        const std::size_t buffer = number(view, who, "buffer", 0), offset = number(view, who, "byteOffset", 0), length = number(view, who, "byteLength", 0);
        if (buffer >= buffers_.size() || offset + length > buffers_[buffer])
            fail(fmt::format("{} claims {} bytes from byte {} of buffer {}, which are not there", who, length, offset, buffer));
        views_.push_back({length, number(view, who, "byteStride", 0)});
    }

    static std::size_t components(const std::string& type)
    {
        return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" || type == "MAT2" ? 4 : type == "MAT3" ? 9 : 16;
    }

    void check_accessor(const json& accessor)
    {
        const std::string who = fmt::format("accessor {}", accessors_++);
        const std::size_t count = number(accessor, who, "count", 0);
        const std::size_t type = number(accessor, who, "componentType", 5126);
        const std::size_t bytes = type <= 5121 ? 1 : type <= 5123 ? 2 : 4;
        const std::string shape = accessor.contains("type") && accessor["type"].is_string() ? accessor["type"].get<std::string>() : "MAT4";
        const std::size_t item = bytes * components(shape), offset = number(accessor, who, "byteOffset", 0);
        const std::size_t view = number(accessor, who, "bufferView", views_.size());
        if (view >= views_.size() && accessor.contains("bufferView"))
            fail(fmt::format("{} names buffer view {}, which does not exist", who, view));
        // Without a view all items are zero, or given as exceptions: then more items than the file has bytes are a lie.
        const std::size_t room = view < views_.size() ? views_[view].length : item * bytes_.size();
        const std::size_t step = view < views_.size() && views_[view].stride > 0 ? views_[view].stride : item;
        if (count > 0 && (offset + item > room || count - 1 > (room - offset - item) / step))
            fail(fmt::format("{} claims {} items of {} bytes, but its buffer view has {} bytes", who, count, item, room));
    }

    struct View {
        std::size_t length, stride;
    };

    std::string_view bytes_;
    const std::string& name_;
    std::size_t json_at_ = 0, binary_ = 0, accessors_ = 0;
    std::vector<std::size_t> buffers_;
    std::vector<View> views_;
};

} // namespace

void check_gltf_claims(std::string_view bytes, bool binary, const std::string& name) { GltfClaims(bytes, name).check(binary); }

} // namespace limn
