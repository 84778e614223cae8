#include "limn/terrain/terrain_pyramid_view.h"

#include <algorithm>
#include <functional>
#include <iterator>
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

    /// A wanted tile, with how much it shows, in pixels: at least as much as those that need it.
    struct Wanted {
        TileId id;
        double shows;
    };
    /// Below the coarsest level, those that show most first; what a tile needs comes before it.
    std::vector<Wanted> wanted() const
    {
        std::vector<Wanted> all;
        for (const auto& [number, wanted] : wanted_)
            if (wanted.id.level < layout_.top())
                all.push_back(wanted);
        std::sort(all.begin(), all.end(), [&](const Wanted& a, const Wanted& b) {
            return std::make_tuple(-a.shows, layout_.index(a.id)) <
                   std::make_tuple(-b.shows, layout_.index(b.id)); // coarser levels have lower numbers
        });
        return all;
    }

private:
    struct State {
        bool may_split = false, usable = false, wanted = false;
        const TerrainTile* tile = nullptr;
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
}

std::size_t TerrainPyramidView::tile_bytes() const
{
    const std::size_t points = std::size_t(pyramid_.layout().tile_points());
    return (points + 2) * (points + 2) * sizeof(float) + points * points * sizeof(PointBounds);
}

void TerrainPyramidView::take_arrivals()
{
    for (TileLoader::Arrival& arrival : loader_.take()) {
        const std::size_t number = pyramid_.layout().index(arrival.id);
        if (!arrival.tile) {
            faults_[number] = arrival.fault;
            continue;
        }
        bytes_ += arrival.tile->bytes();
        residents_[number] = {std::move(arrival.tile), frame_number_};
    }
}

const TerrainPyramidView::Frame& TerrainPyramidView::update(const Camera& camera, const ViewTolerance& tolerance, const std::vector<TileId>& others)
{
    const Lattice& lattice = pyramid_.lattice();
    const PyramidTest test = view_test(pyramid_, camera, tolerance, 0, options_.exaggerate);
    ++frame_number_;
    take_arrivals();
    Tiles tiles(*this, test);
    frame_ = {};
    for (const PyramidLeaf& leaf : root_pyramid_leaves(lattice, tiles))
        each_pyramid_leaf(lattice, leaf, tiles, test, [&](const PyramidLeaf& found) {
            if (tiles.take_waits())
                frame_.unmet.push_back(std::uint32_t(frame_.leaves.size()));
            frame_.leaves.push_back(found);
        });
    ask_for(tiles, others);
    return frame_;
}

SharedTile TerrainPyramidView::find(const TileId& id) const
{
    const auto resident = residents_.find(pyramid_.layout().index(id));
    return resident == residents_.end() ? nullptr : resident->second.tile;
}

/// Asks for what is missing, that which shows most first, as far as the budget goes.
void TerrainPyramidView::ask_for(const Tiles& tiles, const std::vector<TileId>& others)
{
    const PyramidLayout& layout = pyramid_.layout();
    std::vector<TileId> wanted;
    std::unordered_set<std::size_t> known;
    for (const Tiles::Wanted& tile : tiles.wanted()) {
        wanted.push_back(tile.id);
        known.insert(layout.index(tile.id));
    }
    const std::size_t room = options_.budget / tile_bytes();
    frame_.over_budget = wanted.size() > room;
    std::copy_if(others.begin(), others.end(), std::back_inserter(wanted), [&](const TileId& id) { return id.level < layout.top() && !known.contains(layout.index(id)); });
    wanted.resize(std::min(wanted.size(), room));
    std::vector<TileId> missing;
    for (const TileId& id : wanted) {
        const std::size_t number = layout.index(id);
        if (const auto resident = residents_.find(number); resident != residents_.end())
            resident->second.last_used = frame_number_;
        else if (const auto fault = faults_.find(number); fault != faults_.end())
            frame_.fault = fault->second;
        else
            missing.push_back(id);
    }
    frame_.missing = missing.size();
    make_room(missing);
    loader_.want(missing);
}

/// Lets tiles go that no one wants, those first that were not used for longest. What is still being read takes room too, wanted or not; where
/// there is none left, the last of what is missing has to wait.
void TerrainPyramidView::make_room(std::vector<TileId>& missing)
{
    loader_.want({}); // no reading begins while what is being read is counted
    const std::vector<TileId> under_way = loader_.under_way();
    const auto unwanted = std::count_if(under_way.begin(), under_way.end(),
                                        [&](const TileId& id) { return std::find(missing.begin(), missing.end(), id) == missing.end(); });
    std::size_t coming = missing.size() + std::size_t(unwanted);
    std::vector<std::pair<std::uint64_t, std::size_t>> idle; // frame and number
    for (const auto& [number, resident] : residents_)
        if (resident.last_used < frame_number_ && number >= top_tiles_)
            idle.emplace_back(resident.last_used, number);
    std::sort(idle.begin(), idle.end(), std::greater<>());
    const auto is_full = [&] { return bytes_ - top_bytes_ + coming * tile_bytes() > options_.budget; };
    for (; is_full() && !idle.empty(); idle.pop_back()) {
        bytes_ -= residents_.at(idle.back().second).tile->bytes();
        residents_.erase(idle.back().second);
    }
    for (; is_full() && !missing.empty(); --coming)
        missing.pop_back();
    most_bytes_ = std::max(most_bytes_, bytes_ + coming * tile_bytes());
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
