#include "limn/drawing/pdf.h"

#include <memory>

#include <cairo-pdf.h>
#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/drawing/cairo_paint.h"

namespace limn {
namespace {

struct DeleteCairo {
    void operator()(cairo_surface_t* surface) { cairo_surface_destroy(surface); }
    void operator()(cairo_t* cairo) { cairo_destroy(cairo); }
};

cairo_status_t append_bytes(void* to, const unsigned char* bytes, unsigned int count)
{
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), count);
    return CAIRO_STATUS_SUCCESS;
}

void check(cairo_status_t status)
{
    if (status != CAIRO_STATUS_SUCCESS)
        throw Error::Write(fmt::format("the PDF cannot be made: {}", cairo_status_to_string(status)));
}

} // namespace

std::string to_pdf(const Drawing& drawing, const Style& style)
{
    const Painting painting = compose(drawing, style);
    const PageLayout& page = painting.page;
    const double points_per_unit = page.mm_per_unit * 72 / 25.4;
    std::string bytes;
    {
        const std::unique_ptr<cairo_surface_t, DeleteCairo> surface(
            cairo_pdf_surface_create_for_stream(append_bytes, &bytes, page.width * points_per_unit, page.height * points_per_unit));
        cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
        cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATOR, "Limn");
        const std::unique_ptr<cairo_t, DeleteCairo> cairo(cairo_create(surface.get()));
        cairo_scale(cairo.get(), points_per_unit, points_per_unit);
        if (painting.paper != vec3(1)) {
            cairo_set_source_rgb(cairo.get(), double(painting.paper.r), double(painting.paper.g), double(painting.paper.b));
            cairo_paint(cairo.get());
        }
        paint(cairo.get(), painting);
        cairo_show_page(cairo.get());
        check(cairo_status(cairo.get()));
        cairo_surface_finish(surface.get());
        check(cairo_surface_status(surface.get()));
    }
    return bytes;
}

void write_pdf(const Drawing& drawing, const std::filesystem::path& path, const Style& style) { write_file(path, to_pdf(drawing, style)); }

} // namespace limn
