#include "eyes.h"

#include <algorithm>

#include <fmt/format.h>

#include "limn/lines/inside.h"

using namespace limn;

EyePlace place_of_eye(const LineModel& model, const RayScene& rays, const Camera& camera)
{
    const View view = model.view(camera);
    if (is_eye_on_surface(model, view))
        return EyePlace::on_surface;
    return components_around(model, rays, view).empty() ? EyePlace::outside : EyePlace::inside;
}

std::vector<std::string> eye_notes(std::span<const EyePlace> eyes)
{
    std::vector<std::string> notes;
    const auto note = [&](EyePlace place, std::string what) {
        const auto count = std::count(eyes.begin(), eyes.end(), place);
        if (count == 0)
            return;
        if (eyes.size() > 1)
            what += fmt::format(" in {} of {} views", count, eyes.size());
        notes.push_back(what);
    };
    note(EyePlace::inside, "the eye is inside a closed model");
    note(EyePlace::on_surface, "the eye is on the surface");
    return notes;
}
