#include "terrain_window.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include <fmt/format.h>

#include "limn/base/file.h"
#include "limn/drawing/png.h"
#include "mesher.h"
#include "viewpoint.h"
#include "window.h"

using namespace limn;

namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

gpu::TerrainPaint paint_of(const TerrainSettings& settings)
{
    gpu::TerrainPaint paint;
    paint.to_sun = sun_direction(settings.picture);
    if (settings.picture.colours == TerrainPictureOptions::Colours::plain)
        paint.plain = plain_ground;
    paint.marks = settings.marks;
    paint.mesh_lines = settings.mesh_lines;
    paint.background = settings.picture.background;
    return paint;
}

/// The first of stem-1.png, stem-2.png ... that does not exist.
std::string free_name(const std::string& stem)
{
    for (int number = 1;; ++number)
        if (std::string name = fmt::format("{}-{}.png", stem, number); !std::filesystem::exists(name))
            return name;
}

class TerrainWindow {
public:
    TerrainWindow(std::unique_ptr<MovingTerrain> terrain, const TerrainWindowOptions& options)
        : options_(options), settings_(options.settings), window_(options.title, options.camera.size, options.frames > 0),
          start_(Viewpoint::of(options.camera)), view_(start_), wanted_(request()), painter_(terrain->frame(), terrain->layout()),
          mesher_(std::move(terrain), wanted_, Window::wake)
    {
        report_.driver = window_.driver();
    }
    TerrainWindowReport run()
    {
        while (!window_.is_closed()) {
            wait();
            if (const ivec2 size = window_.size(); size.x > 0 && size.y > 0) // none while it is hidden
                frame(size);
        }
        report_.camera = view_.camera();
        return std::move(report_);
    }

private:
    MeshRequest request() const { return {view_.camera(), {.pixels = settings_.pixels}, settings_.exaggerate, tries_}; }
    /// Draws on while something happens, and a few frames longer, which panels need; then the terrain once more, finely.
    void wait()
    {
        constexpr double breath = 0.25, long_time = 60; // seconds
        if (options_.frames > 0 || rest_ < 3) {
            window_.wait(0);
            return;
        }
        const Clock::time_point start = Clock::now();
        window_.wait(is_fine_ ? long_time : breath);
        is_fine_ = is_fine_ || ms_since(start) > 0.9e3 * breath;
    }
    /// Something that is seen is not as it was.
    void change() { is_painted_ = false, is_fine_ = false, rest_ = 0; }
    bool is_last_frame() const { return shown_ && report_.frame_ms.size() + 1 == std::size_t(options_.frames); }

    void frame(const ivec2& size)
    {
        const Clock::time_point start = Clock::now();
        view_.lens.size = size;
        window_.begin_frame();
        const Gestures gestures = window_.gestures();
        follow(gestures);
        take_mesh();
        if (shows_panel_ && show_panel(settings_, facts()))
            ++tries_;
        if (const MeshRequest now = request(); !(now == wanted_)) {
            wanted_ = now;
            mesher_.ask(now);
            change();
        }
        paint(size);
        if (gestures.picture)
            save();
        const bool is_counted = options_.frames > 0 && shown_;
        if (is_last_frame()) {
            report_.last = window_.read();
            window_.close();
        }
        window_.draw_panels();
        window_.end_frame();
        last_frame_ms_ = ms_since(start);
        if (is_counted) {
            report_.frame_ms.push_back(last_frame_ms_);
            report_.frames_unmet += shown_->step.unmet > 0;
            view_.table = view_.table.turned(options_.turn_degrees, 0);
        }
    }
    void follow(const Gestures& g)
    {
        const double seconds = std::min(0.1, 1e-3 * ms_since(last_time_));
        last_time_ = Clock::now();
        rest_ = g.flight == dvec3(0) ? rest_ + 1 : 0; // keys that are held say nothing more
        if (g.pressed) {
            grasped_ = depth_at(g.cursor);
            if (const std::optional<double> depth = depth_at(dvec2(view_.lens.size) / 2.0); depth && g.turns)
                view_.table = view_.table.around_depth(*depth);
        } else if (g.turns) {
            view_ = turned(view_, g.moved);
        } else if (g.pans) {
            view_ = panned(view_, g.moved, grasped_);
        }
        if (g.wheel != 0)
            view_ = zoomed(view_, g.wheel, g.cursor, depth_at(g.cursor));
        if (g.flight != dvec3(0))
            view_ = flown(view_, g.flight, seconds);
        if (g.fit)
            view_ = {start_.table, view_.lens}, view_.lens.ortho_height = start_.lens.ortho_height;
        if (g.from_above)
            view_.table = view_.table.turned(-view_.table.azimuth, 90);
        settings_.marks = settings_.marks != g.marks;
        settings_.mesh_lines = settings_.mesh_lines != g.mesh_lines;
        shows_panel_ = shows_panel_ != g.panel;
    }
    /// Of the ground in the picture that is shown.
    std::optional<double> depth_at(const dvec2& pixel) const
    {
        if (!picture_)
            return {};
        const int scale = picture_->size().y / std::max(1, view_.lens.size.y);
        return painter_.depth_at(*picture_, drawn_camera_, ivec2(pixel * double(scale)));
    }
    void take_mesh()
    {
        std::optional<MeshAnswer> answer = mesher_.take();
        if (!answer)
            return;
        if (answer->step.model)
            painter_.take(*answer->step.model);
        painter_.take(answer->step.light);
        answer->step.model.reset(), answer->step.light = {}; // the device has them
        report_.mesh_ms.push_back(answer->milliseconds);
        report_.triangles = answer->step.triangles;
        report_.unmet = answer->step.unmet;
        report_.missing = answer->step.missing;
        report_.most_tile_bytes = std::max(report_.most_tile_bytes, answer->step.tile_bytes);
        report_.fault = answer->step.fault;
        shown_ = std::move(answer);
        change();
    }
    PanelFacts facts() const
    {
        if (!shown_)
            return {{BoundStatus::Kind::following, "preparing ..."}, {}, false};
        const TerrainStep& step = shown_->step;
        PanelFacts facts = {bound_status(step, settings_.pixels, shown_->request == wanted_), {}, !step.fault.empty()};
        facts.lines.push_back(fmt::format("{} triangles, {:.1f} MB of tiles", step.triangles, double(step.tile_bytes) / (1 << 20)));
        facts.lines.push_back(fmt::format("{:.1f} ms a frame, {:.1f} ms the mesh", last_frame_ms_, shown_->milliseconds));
        if (step.under_ground > 0)
            facts.lines.push_back(fmt::format("the eye is {:.4g} m under the ground", step.under_ground));
        facts.lines.insert(facts.lines.end(), said_.begin(), said_.end());
        return facts;
    }
    /// Fine pictures have four samples a pixel.
    void paint(const ivec2& size)
    {
        if (const gpu::TerrainPaint now = paint_of(settings_); !(now == paint_)) {
            paint_ = now;
            change();
        }
        is_fine_ = is_fine_ || is_last_frame(); // of a script
        const ivec2 drawn = size * (is_fine_ ? 2 : 1);
        if (!picture_ || picture_->size() != drawn) {
            picture_.emplace(drawn, std::vector{gpu::Format::rgba8});
            is_painted_ = false;
        }
        if (!is_painted_) {
            drawn_camera_ = view_.camera();
            painter_.draw(*picture_, drawn_camera_, paint_);
            is_painted_ = true;
        }
        picture_->copy_to_window(size);
    }
    void save()
    {
        const std::string name = free_name(options_.picture_stem);
        write_file(name, encode_png(window_.read(), {}));
        report_.pictures.push_back(name);
        said_ = {"wrote " + name};
        rest_ = 0;
    }

    const TerrainWindowOptions& options_;
    TerrainSettings settings_;
    Window window_;
    Viewpoint start_, view_;
    std::size_t tries_ = 0;
    MeshRequest wanted_;
    gpu::TerrainPainter painter_;
    gpu::TerrainPaint paint_;
    std::optional<gpu::Framebuffer> picture_;
    bool is_painted_ = false, is_fine_ = false; ///< the picture: as it is to be, and with more samples
    Camera drawn_camera_;
    std::optional<MeshAnswer> shown_;
    std::optional<double> grasped_; ///< depth of what was under the cursor when a button went down
    std::vector<std::string> said_;
    TerrainWindowReport report_;
    Clock::time_point last_time_ = Clock::now();
    double last_frame_ms_ = 0;
    int rest_ = 0; ///< frames since something happened
    bool shows_panel_ = true;
    Mesher mesher_; ///< last: it wakes the window
};

} // namespace

TerrainWindowReport run_terrain_window(std::unique_ptr<MovingTerrain> terrain, const TerrainWindowOptions& options)
{
    return TerrainWindow(std::move(terrain), options).run();
}
