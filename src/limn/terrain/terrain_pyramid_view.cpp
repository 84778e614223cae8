#include "limn/terrain/terrain_pyramid_view.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <tuple>
#include <unordered_set>
#include <utility>

#include "limn/base/error.h"
#include "limn/terrain/pyramid_walk.h"

namespace limn {
namespace {

/// The tiles of the next coarser level that touch a tile: four, fewer at the lattice's border.
template <class F> void each_touching_above(const PyramidLayout& layout, const TileId& id, F&& f)
{
    const ivec2 above = id.at / 2, aside = above + ivec2(id.at.x % 2 == 0 ? -1 : 1, id.at.y % 2 == 0 ? -1 : 1),
                end = layout.tiles(id.level + 1);
    for (const int y : {above.y, aside.y})
        for (const int x : {above.x, aside.x})
            if (x >= 0 && y >= 0 && x < end.x && y < end.y)
                f(TileId{id.level + 1, {x, y}});
}

} // namespace

/// The tiles that one frame can use, and what it misses.
class TerrainPyramidView::Tiles {
public:
    Tiles(TerrainPyramidView& view, const PyramidTest& test) : view_(view), layout_(view.pyramid_.layout()), test_(test) {}

    const TerrainTile* tile_for(const BisectionTriangle& t)
    {
        const TileId id = layout_.tile_of(t);
        State& own = state(id);
        want(id, own);
        if (!own.usable) {
            waits_ = waits_ || own.may_split;
            return nullptr;
        }
        if (!own.tile)
            return nullptr; // nothing in it is split
        if (const TileId other = across(id, t.middle()); !(other == id)) {
            State& beyond = state(other);
            want(other, beyond);
            if (!beyond.usable) {
                waits_ = waits_ || beyond.may_split;
                return nullptr;
            }
        }
        return own.tile;
    }
    const TerrainTile& top(const TileId& id) { return *state(id).tile; }
    /// Whether a tile that is missing was asked for since the last call.
    bool take_waits() { return std::exchange(waits_, false); }

    /// Tiles below the coarsest level, those that show most first; what a tile needs comes before it.
    std::vector<TileId> wanted() const
    {
        std::vector<Wanted> all;
        for (const auto& [number, wanted] : wanted_)
            if (wanted.id.level < layout_.top())
                all.push_back(wanted);
        std::sort(all.begin(), all.end(), [&](const Wanted& a, const Wanted& b) {
            return std::make_tuple(-a.shows, layout_.index(a.id)) <
                   std::make_tuple(-b.shows, layout_.index(b.id)); // coarser levels have lower numbers
        });
        std::vector<TileId> tiles;
        for (const Wanted& wanted : all)
            tiles.push_back(wanted.id);
        return tiles;
    }

private:
    struct State {
        bool may_split = false, usable = false, wanted = false;
        const TerrainTile* tile = nullptr;
    };
    /// A tile with how much it shows, in pixels: at least as much as those that need it.
    struct Wanted {
        TileId id;
        double shows;
    };
    State& state(const TileId& id)
    {
        const std::size_t number = layout_.index(id);
        if (const auto known = states_.find(number); known != states_.end())
            return known->second;
        State state;
        const auto resident = view_.residents_.find(number);
        const bool is_here = resident != view_.residents_.end();
        state.may_split = id.level == layout_.top() || test_.may_split(id);
        if (is_here && state.may_split)
            state.tile = resident->second.tile.get();
        state.usable = is_here || !state.may_split;
        if (id.level < layout_.top())
            each_touching_above(layout_, id, [&](const TileId& above) { state.usable = this->state(above).usable && state.usable; });
        return states_[number] = state;
    }
    /// The tile on the other side of a border that a point is on, else the tile itself.
    TileId across(const TileId& id, const ivec2& p) const
    {
        const int size = layout_.tile_samples(id.level);
        const ivec2 in_tile = p - id.at * size, last = layout_.tiles(id.level) - 1;
        TileId other = id;
        for (int axis = 0; axis < 2; ++axis) {
            if (in_tile[axis] == 0 && id.at[axis] > 0)
                --other.at[axis];
            else if (in_tile[axis] == size && id.at[axis] < last[axis])
                ++other.at[axis];
        }
        return other;
    }
    /// A tile that this frame can do something with, and all that have to be there for it.
    void want(const TileId& id, State& state)
    {
        if (state.wanted || !state.may_split)
            return;
        state.wanted = true;
        want(id, id.level == layout_.top() ? std::numeric_limits<double>::infinity() : test_.error(id));
    }
    void want(const TileId& id, double shows)
    {
        Wanted& entry = wanted_.try_emplace(layout_.index(id), Wanted{id, -1}).first->second;
        if (entry.shows >= shows)
            return;
        entry.shows = shows;
        if (id.level < layout_.top())
            each_touching_above(layout_, id, [&](const TileId& above) {
                if (this->state(above).may_split)
                    want(above, shows);
            });
    }

    TerrainPyramidView& view_;
    const PyramidLayout& layout_;
    const PyramidTest& test_;
    std::unordered_map<std::size_t, State> states_;
    std::unordered_map<std::size_t, Wanted> wanted_;
    bool waits_ = false;
};

TerrainPyramidView::TerrainPyramidView(const TerrainPyramid& pyramid, const TerrainPyramidViewOptions& options)
    : pyramid_(pyramid), options_(options), loader_(pyramid, options.loaders)
{
    const PyramidLayout& layout = pyramid.layout();
    const ivec2 tiles = layout.tiles(layout.top());
    for (int y = 0; y < tiles.y; ++y)
        for (int x = 0; x < tiles.x; ++x) {
            const TileId id = {layout.top(), {x, y}};
            const auto tile = std::make_shared<const TerrainTile>(pyramid.read(id));
            residents_[layout.index(id)] = {tile, 0};
            top_bytes_ += tile->bytes();
            ++top_tiles_;
        }
    bytes_ = most_bytes_ = top_bytes_;
    if (layout.top() > 0) {
        const TerrainTile tile = empty_tile(layout, {0, {0, 0}});
        tile_bytes_ = tile.bytes(), heights_bytes_ = tile.heights.size() * sizeof(float);
    }
}

/// @return whether there are more tiles for the mesh
bool TerrainPyramidView::take_arrivals()
{
    bool for_mesh = false;
    passing_.clear();
    for (TileLoader::Arrival& arrival : loader_.take()) {
        const std::size_t number = pyramid_.layout().index(arrival.request.id);
        if (!arrival.tile) {
            faults_[number] = arrival.fault;
        } else if (arrival.request.parts == TileParts::heights) {
            passing_[number] = std::move(arrival.tile);
        } else {
            bytes_ += arrival.tile->bytes();
            residents_[number] = {std::move(arrival.tile), frame_number_};
            for_mesh = true;
        }
    }
    return for_mesh;
}

const TerrainPyramidView::Frame& TerrainPyramidView::update(const Camera& camera, const ViewTolerance& tolerance,
                                                            const std::vector<TileId>& others)
{
    ++frame_number_;
    const std::pair seen(camera, tolerance);
    frame_.is_new = take_arrivals() || seen_ != seen;
    if (frame_.is_new) {
        seen_.reset(); // where the tolerance is none, and leaves are not found
        find_leaves(camera, tolerance);
        seen_ = seen;
    }
    ask_for(others);
    return frame_;
}

void TerrainPyramidView::find_leaves(const Camera& camera, const ViewTolerance& tolerance)
{
    const PyramidTest test = view_test(pyramid_, camera, tolerance, 0, options_.exaggerate);
    Tiles tiles(*this, test);
    frame_.leaves.clear();
    frame_.unmet.clear();
    for (const PyramidLeaf& leaf : root_pyramid_leaves(pyramid_.lattice(), tiles))
        each_pyramid_leaf(pyramid_.lattice(), leaf, tiles, test, [&](const PyramidLeaf& found) {
            if (tiles.take_waits())
                frame_.unmet.push_back(std::uint32_t(frame_.leaves.size()));
            frame_.leaves.push_back(found);
        });
    wanted_ = tiles.wanted();
}

SharedTile TerrainPyramidView::find(const TileId& id) const
{
    const std::size_t number = pyramid_.layout().index(id);
    if (const auto resident = residents_.find(number); resident != residents_.end())
        return resident->second.tile;
    const auto passing = passing_.find(number);
    return passing == passing_.end() ? nullptr : passing->second;
}

/// Asks for what is missing, that which shows most first, as far as the budget goes.
void TerrainPyramidView::ask_for(const std::vector<TileId>& others)
{
    constexpr std::size_t most_others = 16; // at a time
    const PyramidLayout& layout = pyramid_.layout();
    const std::size_t room = std::min(wanted_.size(), options_.budget / tile_bytes_);
    frame_.over_budget = wanted_.size() > room;
    frame_.fault.clear();
    std::vector<TileId> missing, heights;
    std::unordered_set<std::size_t> asked;
    for (std::size_t i = 0; i < room; ++i) {
        const std::size_t number = layout.index(wanted_[i]);
        asked.insert(number);
        if (const auto resident = residents_.find(number); resident != residents_.end())
            resident->second.last_used = frame_number_;
        else if (is_to_be_read(wanted_[i]))
            missing.push_back(wanted_[i]);
    }
    for (const TileId& id : others)
        if (!asked.contains(layout.index(id)) && !find(id) && is_to_be_read(id))
            heights.push_back(id);
    frame_.missing = missing.size() + heights.size();
    heights.resize(std::min(heights.size(), most_others));
    make_room(missing, (passing_.size() + heights.size()) * heights_bytes_);
    std::vector<TileRequest> requests;
    for (const TileId& id : missing)
        requests.push_back({id, TileParts::all});
    for (const TileId& id : heights)
        requests.push_back({id, TileParts::heights});
    loader_.want(requests);
}

/// Not one that cannot be: that is told.
bool TerrainPyramidView::is_to_be_read(const TileId& id)
{
    const auto fault = faults_.find(pyramid_.layout().index(id));
    if (fault != faults_.end())
        frame_.fault = fault->second;
    return fault == faults_.end();
}

/// Lets tiles go that no one wants, those first that were not used for longest. What is still being read takes room too, wanted or not; where
/// there is none left, the last of what is missing, and is not being read, has to wait.
/// @param beside  bytes beyond the budget
void TerrainPyramidView::make_room(std::vector<TileId>& missing, std::size_t beside)
{
    loader_.want({}); // no reading begins while what is being read is counted
    std::vector<TileRequest> coming = loader_.under_way();
    std::erase_if(coming, [](const TileRequest& request) { return request.parts != TileParts::all; });
    const auto is_coming = [&](const TileId& id) { return std::find(coming.begin(), coming.end(), TileRequest{id}) != coming.end(); };
    std::size_t count = coming.size() + std::size_t(std::count_if(missing.begin(), missing.end(), std::not_fn(is_coming)));
    std::vector<std::pair<std::uint64_t, std::size_t>> idle; // frame and number
    for (const auto& [number, resident] : residents_)
        if (resident.last_used < frame_number_ && number >= top_tiles_)
            idle.emplace_back(resident.last_used, number);
    std::sort(idle.begin(), idle.end(), std::greater<>());
    const auto is_full = [&] { return bytes_ - top_bytes_ + count * tile_bytes_ > options_.budget; };
    for (; is_full() && !idle.empty(); idle.pop_back()) {
        bytes_ -= residents_.at(idle.back().second).tile->bytes();
        residents_.erase(idle.back().second);
    }
    for (auto last = missing.end(); is_full() && last != missing.begin();)
        if (--last; !is_coming(*last)) {
            last = missing.erase(last);
            --count;
        }
    most_bytes_ = std::max(most_bytes_, bytes_ + count * tile_bytes_ + beside);
}

const TerrainPyramidView::Frame& TerrainPyramidView::finish(const Camera& camera, const ViewTolerance& tolerance)
{
    for (;;) {
        update(camera, tolerance);
        if (!frame_.fault.empty())
            throw Error::Read(frame_.fault);
        if (frame_.missing == 0)
            return frame_;
        wait();
    }
}

} // namespace limn
