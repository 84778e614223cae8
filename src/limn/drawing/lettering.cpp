#include "limn/drawing/lettering.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>

namespace limn {
namespace {

constexpr char degree = '\xb0';

/// Lines on a grid 4 wide and 6 high: a point is its two coordinates, x and y up; a space lifts the pen.
std::string_view glyph(char c)
{
    switch (c) {
    case ' ': return "";
    case 'A': return "002640 1333";
    case 'B': return "00063645443303 3342413000";
    case 'C': return "4536160501103041";
    case 'D': return "00062645412000";
    case 'E': return "40000646 0333";
    case 'F': return "000646 0333";
    case 'G': return "45361605011030414323";
    case 'H': return "0006 4046 0343";
    case 'I': return "0006";
    case 'J': return "4641301001";
    case 'K': return "0006 4602 1340";
    case 'L': return "060040";
    case 'M': return "0006234640";
    case 'N': return "00064046";
    case 'O': case '0': return "160501103041453616";
    case 'P': return "00063645443303";
    case 'Q': return "160501103041453616 2240";
    case 'R': return "00063645443303 2340";
    case 'S': return "453616050413334241301001";
    case 'T': return "0646 2620";
    case 'U': return "060110304146";
    case 'V': return "062046";
    case 'W': return "0610233046";
    case 'X': return "0046 0640";
    case 'Y': return "062346 2320";
    case 'Z': return "06460040";
    case '1': return "051610";
    case '2': return "05163645440040";
    case '3': return "0516364544334241301001 1333";
    case '4': return "30360242";
    case '5': return "460603334241301001";
    case '6': return "36160501103041423303";
    case '7': return "064610";
    case '8': return "13040516364544331302011030414233";
    case '9': return "10304145361605041343";
    case '.': return "0001";
    case ',': return "1100";
    case '-': return "0333";
    case '+': return "0343 2125";
    case '/': return "0046";
    case ':': return "0001 0304";
    case '(': return "16050110";
    case ')': return "06151100";
    case '=': return "0242 0444";
    case '_': return "0040";
    case '\'': return "0604";
    case degree: return "0506161505";
    default: return "0006464000";
    }
}

/// One byte for each sign: the degree sign of UTF-8 has two, others beyond ASCII become one unknown sign.
std::string signs_of(std::string_view text)
{
    std::string signs;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if (byte < 0x80)
            signs += char(std::toupper(byte));
        else if (text.substr(i, 2) == "\xc2\xb0")
            signs += degree;
        else if (byte >= 0xc0)
            signs += '\x7f';
    }
    return signs;
}

} // namespace

std::vector<std::vector<dvec2>> letter(std::string_view text)
{
    constexpr double unit = 1.0 / 6, spacing = 2, space = 3;
    std::vector<std::vector<dvec2>> lines;
    double pen = 0, end = 0;
    for (const char sign : signs_of(text)) {
        const std::string_view points = glyph(sign);
        double width = points.empty() ? space - spacing : 0;
        bool lifted = true;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (points[i] == ' ') {
                lifted = true;
                continue;
            }
            if (std::exchange(lifted, false))
                lines.emplace_back();
            const double x = points[i] - '0', y = points[++i] - '0';
            lines.back().push_back(unit * dvec2(pen + x, -y));
            width = std::max(width, x);
        }
        end = pen + width;
        pen = end + spacing;
    }
    for (auto& line : lines)
        for (dvec2& p : line)
            p.x -= 0.5 * unit * end;
    return lines;
}

} // namespace limn
