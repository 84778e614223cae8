#include "panel.h"

#include <imgui.h>

using namespace limn;

namespace {

constexpr const char* keys = "left drag: turn    right drag, Shift: move\n"
                             "wheel: nearer, further    W A S D Q E: fly\n"
                             "F: all of it    T: from above    P: picture\n"
                             "M: marks    G: mesh    H: panel    Esc: close";

ImVec4 colour_of(BoundStatus::Kind kind)
{
    switch (kind) {
    case BoundStatus::Kind::holds: return {0.1f, 0.45f, 0.15f, 1};
    case BoundStatus::Kind::following: return {0.35f, 0.35f, 0.35f, 1};
    default: return {0.75f, 0.05f, 0.3f, 1};
    }
}

/// A slider of a number in double precision.
bool slide(const char* label, double& value, double low, double high, const char* format, bool by_ratio = false)
{
    return ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &low, &high, format,
                               ImGuiSliderFlags_AlwaysClamp | (by_ratio ? ImGuiSliderFlags_Logarithmic : 0));
}

} // namespace

bool show_panel(TerrainSettings& settings, const PanelFacts& facts)
{
    ImGui::SetNextWindowPos({10, 10}, ImGuiCond_Once);
    ImGui::Begin("Terrain", nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoNav);
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
    ImGui::TextColored(colour_of(facts.bound.kind), "%s", facts.bound.text.c_str());
    ImGui::PopTextWrapPos();
    const bool retry = facts.can_retry && ImGui::Button("Try again");
    for (const std::string& line : facts.lines)
        ImGui::TextUnformatted(line.c_str());
    ImGui::Separator();
    ImGui::PushItemWidth(ImGui::GetFontSize() * 12);
    slide("bound, px", settings.pixels, 0.1, 20, "%.2f", true);
    slide("heights, times", settings.exaggerate, 0.1, 10, "%.2f", true);
    slide("sun from, degrees", settings.picture.sun_azimuth, -360, 360, "%.0f");
    slide("sun's height, degrees", settings.picture.sun_height, 0, 90, "%.0f");
    ImGui::PopItemWidth();
    bool tinted = settings.picture.colours == TerrainPictureOptions::Colours::tint;
    if (ImGui::Checkbox("colours by height", &tinted))
        settings.picture.colours = tinted ? TerrainPictureOptions::Colours::tint : TerrainPictureOptions::Colours::plain;
    ImGui::Checkbox("mark what may break the bound", &settings.marks);
    ImGui::Checkbox("edges of triangles", &settings.mesh_lines);
    ImGui::Separator();
    ImGui::TextDisabled("%s", keys);
    ImGui::End();
    return retry;
}
