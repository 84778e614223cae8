#include "limn/lines/strokes.h"

#include <algorithm>
#include <cmath>

#include "limn/base/parallel.h"
#include "limn/lines/clip.h"

namespace limn {
namespace {

/// What is made of an element.
enum class Fate : std::uint8_t { hidden, visible, left_out };

Fate fate_of(const Element& e) { return e.inked ? Fate::left_out : e.visible ? Fate::visible : Fate::hidden; }

/// Elements [begin, end) of a chain, counted on past its end where a closed chain is walked from its middle.
struct Run {
    std::size_t begin, end;
    Fate fate;
    bool inner; ///< a run of another fate stands at both ends
};

class ChainStrokes {
public:
    ChainStrokes(const ViewContext& context, std::span<const Segment> segments, std::span<const Element> elements, bool closed)
        : context_(context), segments_(segments), elements_(elements), closed_(closed)
    {
    }

    std::vector<Run> runs() const
    {
        const std::size_t n = elements_.size();
        std::size_t first = 0;
        if (closed_)
            while (first < n && fate_of(elements_[first]) == fate_of(elements_[(first + n - 1) % n]))
                ++first;
        if (first == n)
            return {{0, n, fate_of(elements_[0]), false}};
        std::vector<Run> runs;
        for (std::size_t k = first; k < first + n;) {
            std::size_t end = k + 1;
            while (end < first + n && fate_of(element(end)) == fate_of(element(k)))
                ++end;
            runs.push_back({k, end, fate_of(element(k)), closed_ || (k > 0 && end < n)});
            k = end;
        }
        return runs;
    }

    /// Hidden runs too short to be seen become visible; then visible ones too short to be drawn are dropped, and what is left out.
    std::vector<Run> tidied(double shortest) const
    {
        std::vector<Run> joined;
        for (Run run : runs()) {
            if (run.fate == Fate::hidden && run.inner && extent(run) < shortest)
                run.fate = Fate::visible;
            if (!joined.empty() && joined.back().fate == run.fate)
                joined.back().end = run.end;
            else
                joined.push_back(run);
        }
        if (closed_ && joined.size() > 1 && joined.front().fate == joined.back().fate) {
            joined.front().begin = joined.back().begin;
            joined.front().end += elements_.size();
            joined.pop_back();
        }
        std::erase_if(joined, [&](const Run& run) { return run.fate == Fate::left_out || (run.fate == Fate::visible && extent(run) < shortest); });
        return joined;
    }

    Stroke stroke(const Run& run, LineType type) const
    {
        Stroke s;
        s.type = type;
        s.visible = run.fate == Fate::visible;
        s.closed = closed_ && run.end - run.begin == elements_.size();
        s.object = context_.model.object_of_face(segments_[element(run.begin).segment].face);
        const std::size_t count = run.end - run.begin + (s.closed ? 0 : 1);
        s.points.reserve(count);
        s.world.reserve(count);
        s.ink.reserve(count);
        s.faces.reserve(count);
        for (std::size_t k = run.begin; k < run.end; ++k)
            add_point(s, element(k), element(k).t0);
        if (!s.closed)
            add_point(s, element(run.end - 1), element(run.end - 1).t1);
        return s;
    }

private:
    const Element& element(std::size_t k) const { return elements_[k % elements_.size()]; }

    vec3 position(const Element& e, float t) const
    {
        const Segment& s = segments_[e.segment];
        return t == 0 ? s.a : t == 1 ? s.b : glm::mix(s.a, s.b, t);
    }

    void add_point(Stroke& stroke, const Element& e, float t) const
    {
        const Segment& s = segments_[e.segment];
        const vec3 p = position(e, t);
        stroke.points.push_back(dvec2(context_.projector.project(p)));
        stroke.world.push_back(context_.model.to_world(p));
        stroke.ink.push_back(glm::mix(s.ink_a, s.ink_b, t));
        stroke.faces.push_back(s.face - context_.model.first_face[stroke.object]);
    }

    /// Diagonal of the run's box in the picture, pixels.
    double extent(const Run& run) const
    {
        dvec2 low(1e300), high(-1e300);
        const auto add = [&](const vec3& p) {
            const dvec2 q = dvec2(context_.projector.project(p));
            low = glm::min(low, q);
            high = glm::max(high, q);
        };
        for (std::size_t k = run.begin; k < run.end; ++k)
            add(position(element(k), element(k).t0));
        add(position(element(run.end - 1), element(run.end - 1).t1));
        return glm::length(high - low);
    }

    const ViewContext& context_;
    std::span<const Segment> segments_;
    std::span<const Element> elements_;
    bool closed_;
};

/// Sum of length * weight(i, j) over the pieces between points i and j.
template <class Weight> double sum_over_pieces(const Stroke& stroke, Weight&& weight)
{
    double sum = 0;
    const std::size_t n = stroke.points.size();
    for (std::size_t i = stroke.closed ? 0 : 1; i < n; ++i) {
        const std::size_t before = (i + n - 1) % n;
        sum += weight(before, i) * glm::distance(stroke.points[before], stroke.points[i]);
    }
    return sum;
}

} // namespace

std::vector<Stroke> make_strokes(const ViewContext& context, std::span<const Segment> segments, const Chains& chains,
                                 const ChainElements& decided, const StrokeOptions& options)
{
    return parallel_collect<Stroke>(chains.size(), 16, [&](std::size_t begin, std::size_t end, std::vector<Stroke>& out) {
        for (std::size_t c = begin; c < end; ++c) {
            const std::span<const Element> elements(decided.elements.data() + decided.start[c], decided.elements.data() + decided.start[c + 1]);
            const ChainStrokes chain(context, segments, elements, chains.closed[c]);
            for (const Run& run : chain.tidied(options.shortest))
                if (run.fate == Fate::visible || options.keep_hidden)
                    clip_to_picture(chain.stroke(run, options.type), options.size, out);
        }
    });
}

double length_in_picture(const Stroke& stroke)
{
    return sum_over_pieces(stroke, [](std::size_t, std::size_t) { return 1.0; });
}

double ink_in_picture(const Stroke& stroke)
{
    return sum_over_pieces(stroke, [&](std::size_t i, std::size_t j) { return 0.5 * (double(stroke.ink[i]) + double(stroke.ink[j])); });
}

} // namespace limn
