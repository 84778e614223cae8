// Where a height lies in a stack of layers. Includes ask for `float layer_top(const int k)`, where layer k of the lowest `count` ends, and for
// print_layers.glsl before.

// The number of the lowest layer that ends above a height, or `count`.
FORMULA int layer_at(const LayerRow row, const float at)
{
    int low = 0;
    int high = row.count;
    while (low < high) {
        int middle = (low + high) / 2;
        if (layer_top(middle) <= at)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

// How many layers reach up to a height; fractions count.
FORMULA float layers_below(const LayerRow row, const float at)
{
    int k = layer_at(row, at);
    float low = k == 0 ? row.bottom : layer_top(k - 1);
    float height = k < row.count ? layer_top(k) - low : row.height;
    return float(k) + (at - low) / height;
}

// `change` is that of the height for a pixel to the right and down, and `width` that of the pixel's kernel, pixels: where layers of several heights are
// seen through it, the place changes as they do on average.
FORMULA LayerPlace layer_place(const LayerRow row, const float at, const vec2 change, const float width)
{
    int k = layer_at(row, at);
    float low = k == 0 ? row.bottom : layer_top(k - 1);
    float own = k < row.count ? layer_top(k) - low : row.height;
    float reach = width * length(change);
    float mean = own;
    if (row.count > 0 && reach > 0.25f * own && reach < 1e30f) // the mean over what the kernel sees
        mean = 2.0f * reach / max(layers_below(row, at + reach) - layers_below(row, at - reach), 1e-6f);
    LayerPlace place = {float(k) + (at - low) / own, own, change / mean};
    return place;
}
