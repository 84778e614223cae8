#include "image_tiles.h"

#include <algorithm>

using namespace limn;

namespace {

constexpr int gap = 4; ///< pixels between them

} // namespace

Image tile_images(const std::vector<Image>& images, int columns)
{
    const ivec2 size = images.front().size(), tiles = {std::min(columns, int(images.size())), (int(images.size()) + columns - 1) / columns};
    Image all(tiles * (size + gap) - gap, 3, 1.0f);
    for (std::size_t k = 0; k < images.size(); ++k) {
        const ivec2 corner = ivec2(int(k) % columns, int(k) / columns) * (size + gap);
        const Image& image = images[k];
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                for (int c = 0; c < 3; ++c)
                    all.at(corner.x + x, corner.y + y)[c] = image.at(x, y)[image.channels == 1 ? 0 : c];
    }
    return all;
}
