#include "limn/pattern/read_gcode.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/mapped_file.h"
#include "limn/pattern/bead_section.h"
#include "limn/pattern/gcode_arc.h"
#include "limn/pattern/gcode_comment.h"
#include "limn/pattern/gcode_layers.h"
#include "limn/pattern/gcode_words.h"

namespace limn {
namespace {

constexpr double farthest = 1e6;     ///< mm
constexpr double bytes_of_move = 24; ///< a line at least, to guess how many there are
constexpr int most_turns = 100;      ///< of one arc
constexpr int most_tools = 64;       ///< numbers above are firmware's own commands (BambuStudio's T1000)

enum Word { X, Y, Z, E, F, I, J, R, P, word_count };

/// The words of a move; mm, of F mm/min.
struct MoveWords {
    double value[word_count] = {};
    unsigned given = 0; ///< bit by bit
    bool has(Word w) const { return (given >> w & 1) != 0; }
};

/// The word that stands there, for messages.
std::string shown_word(const GcodeWords& words)
{
    std::string word(words.rest().substr(0, std::min<std::size_t>(words.rest().find_first_of(" \t\r;"), 20)));
    std::replace_if(
        word.begin(), word.end(), [](unsigned char c) { return c < 0x20 || c > 0x7e; }, '?');
    return word;
}

int word_index(char letter)
{
    switch (letter) {
    case 'X': return X;
    case 'Y': return Y;
    case 'Z': return Z;
    case 'E': return E;
    case 'F': return F;
    case 'I': return I;
    case 'J': return J;
    case 'R': return R;
    case 'P': return P;
    default: return -1;
    }
}

/// What a printer knows while it works.
class Machine {
public:
    Machine(std::string_view text, const std::string& name, const GcodeOptions& options)
        : text_(text), name_(name), arc_error_(options.arc_error), layers_(tells_of_layers(text))
    {
        const double told = told_filament_diameter(text);
        has_settings_ = told > 0;
        path_.filament_diameter = options.filament_diameter > 0 ? options.filament_diameter : told > 0 ? told : path_.filament_diameter;
        thread_ = thread_area(path_.filament_diameter);
    }

    PrintPath run()
    {
        check_text();
        path_.moves.reserve(std::size_t(double(text_.size()) / bytes_of_move));
        for (std::size_t at = 0; at < text_.size();) {
            const std::size_t end = std::min(text_.find('\n', at), text_.size());
            ++path_.lines;
            read_line(text_.substr(at, end - at));
            at = end + 1;
        }
        finish();
        return std::move(path_);
    }

private:
    [[noreturn]] void fail(const std::string& what) const { throw Error::Read(fmt::format("{}: line {}: {}", name_, path_.lines, what)); }
    [[noreturn]] void fail_file(const std::string& what) const { throw Error::Read(fmt::format("{}: {}", name_, what)); }

    void check_text() const
    {
        if (text_.starts_with("GCDE"))
            fail_file("is binary G-code; let the slicer write it as text");
        if (const std::size_t zero = text_.find('\0'); zero != std::string_view::npos)
            fail_file(fmt::format("line {}: a byte 0: this is no text",
                                  1 + std::count(text_.begin(), text_.begin() + std::ptrdiff_t(zero), '\n')));
    }

    void read_line(std::string_view line)
    {
        if (!line.empty() && line[0] == ';') {
            take_comment(gcode_comment(line.substr(1)));
            return;
        }
        GcodeWords words(line);
        char letter = words.peek();
        if (letter == 'N' && !take_line_number(words, line))
            return;
        for (letter = words.peek(); letter != '\0' && letter != '*'; letter = words.peek())
            if (!take_command(words, letter))
                return;
    }

    /// @return false where that is no number but a macro's name
    bool take_line_number(GcodeWords& words, std::string_view line) const
    {
        words.take_letter();
        int number = 0;
        if (!words.take_code(number))
            return false;
        const std::string_view code = line.substr(0, line.find(';'));
        const std::size_t star = code.rfind('*');
        if (star == std::string_view::npos)
            return true;
        GcodeWords behind(code.substr(star + 1));
        int told = 0, own = 0;
        if (behind.peek() == '\0' || !behind.take_code(told))
            fail("'*' is not followed by a checksum");
        for (const char c : code.substr(0, star))
            own ^= int(static_cast<unsigned char>(c));
        if (told != own)
            fail(fmt::format("its checksum is {}, but the line has {}", told, own));
        return true;
    }

    /// @return whether another command may follow in the line
    bool take_command(GcodeWords& words, char letter)
    {
        if (word_index(letter) >= 0)
            return take_move_without_command(words, letter);
        words.take_letter();
        int code = 0, sub = 0;
        if ((letter != 'G' && letter != 'M' && letter != 'T') || !words.take_code(code))
            return false;
        if (words.peek() == '.') {
            words.take_letter();
            words.take_code(sub);
        }
        if (letter == 'G')
            return take_g(words, code, sub);
        if (letter == 'M')
            return take_m(words, code);
        if (code < most_tools)
            tool_ = std::uint8_t(code);
        return true;
    }

    bool take_g(GcodeWords& words, int code, int sub)
    {
        switch (code) {
        case 0:
        case 1:
        case 2:
        case 3:
            motion_ = code;
            take_motion(take_words(words));
            return true;
        case 5: fail("splines (G5) cannot be read; let the slicer write lines or arcs");
        case 17: level_arcs_ = true; return true;
        case 18:
        case 19: level_arcs_ = false; return true;
        case 20: unit_ = 25.4; return true;
        case 21: unit_ = 1; return true;
        case 28: go_home(words); return false;
        case 90: relative_ = false; return true;
        case 91: relative_ = true; return true;
        case 92: set_place(words, sub); return false;
        default: return false;
        }
    }

    bool take_m(GcodeWords& words, int code)
    {
        if (code == 82 || code == 83) {
            filament_relative_ = code == 83;
            return true;
        }
        if (code == 200 && words.peek() == 'D') {
            words.take_letter();
            double diameter = 0;
            if (!words.take_number(diameter))
                fail("M200: D is not followed by a number");
            volumetric_ = diameter > 0;
        }
        return false;
    }

    /// "X10 Y20" goes on with the motion of the line before. A macro's name may begin like that.
    bool take_move_without_command(GcodeWords& words, char letter)
    {
        GcodeWords ahead = words;
        ahead.take_letter();
        double number = 0;
        if (!ahead.take_number(number))
            return false;
        if (motion_ < 0)
            fail(fmt::format("{} moves, but no line before says how (G0, G1, G2 or G3)", letter));
        take_motion(take_words(words));
        return true;
    }

    MoveWords take_words(GcodeWords& words) const
    {
        MoveWords move;
        for (char letter = words.peek(); letter != '\0' && letter != '*' && letter != 'G' && letter != 'M' && letter != 'T';
             letter = words.peek()) {
            const int index = word_index(letter);
            if (index < 0 &&
                std::string_view("SHDKLQ").find(letter) == std::string_view::npos) // power of lasers and the like, which does not move
                fail_word(words, letter);
            words.take_letter();
            double value = 0;
            if (!words.take_number(value))
                fail(fmt::format("{} is followed by '{}', not by a number", letter, shown_word(words)));
            if (index < 0)
                continue;
            move.value[index] = index == P ? value : unit_ * value;
            move.given |= 1u << index;
        }
        return move;
    }

    [[noreturn]] void fail_word(const GcodeWords& words, char letter) const
    {
        const std::string word = shown_word(words);
        if (std::string_view("ABCUVW").find(letter) != std::string_view::npos)
            fail(fmt::format("'{}': printers have the axes X, Y, Z and E, but no {}", word, letter));
        fail(fmt::format("'{}' is no word of a move", word));
    }

    dvec3 target(const MoveWords& move) const
    {
        dvec3 to = at_;
        for (int k = 0; k < 3; ++k)
            if (move.has(Word(k)))
                to[k] = move.value[k] + (relative_ ? at_[k] : shift_[k]);
        for (int k = 0; k < 3; ++k)
            if (!(std::abs(to[k]) <= farthest))
                fail(fmt::format("{} {:g} mm is farther than {:g} mm", "XYZ"[k], to[k], farthest));
        return to;
    }

    /// mm of filament that go in.
    double take_filament(const MoveWords& move)
    {
        if (!move.has(E))
            return 0;
        const double change = relative_ || filament_relative_ ? move.value[E] : move.value[E] - filament_;
        filament_ += change;
        if (!(std::abs(filament_) <= 1e9))
            fail(fmt::format("E {:g} is farther than 1e9 mm", filament_));
        return volumetric_ ? change / thread_ : change;
    }

    void take_motion(const MoveWords& move)
    {
        if (move.has(F) && move.value[F] > 0)
            speed_ = move.value[F] / 60;
        const dvec3 to = target(move);
        const double filament = take_filament(move);
        path_.retractions += filament < 0;
        if (motion_ <= 1) {
            go(to, filament);
            return;
        }
        arc_.clear();
        append_arc(at_, to, centre_of(move, to), motion_ == 2, turns_of(move), arc_error_, arc_);
        double length = 0;
        dvec3 from = at_;
        for (const dvec3& p : arc_) {
            length += glm::distance(from, p);
            from = p;
        }
        for (const dvec3& p : arc_)
            go(p, length > 0 ? filament * glm::distance(at_, p) / length : 0);
    }

    int turns_of(const MoveWords& move) const
    {
        if (!move.has(P))
            return 0;
        const double turns = move.value[P];
        if (!(turns >= 0 && turns <= most_turns) || turns != std::floor(turns))
            fail(fmt::format("P {:g}: an arc goes around 0 to {} times more", turns, most_turns));
        return int(turns);
    }

    dvec2 centre_of(const MoveWords& move, const dvec3& to) const
    {
        if (!level_arcs_)
            fail("arcs that are not level (G18, G19) cannot be read");
        if (move.has(R)) {
            const std::optional<dvec2> centre = arc_centre(dvec2(at_), dvec2(to), move.value[R], motion_ == 2);
            if (!centre)
                fail(fmt::format("no arc of radius {:g} mm goes from {:g},{:g} to {:g},{:g}", move.value[R], at_.x, at_.y, to.x, to.y));
            return *centre;
        }
        const dvec2 centre = dvec2(at_) + dvec2(move.value[I], move.value[J]);
        const double start = glm::distance(centre, dvec2(at_)), end = glm::distance(centre, dvec2(to));
        if (!(start > 0) || !(std::abs(centre.x) <= farthest && std::abs(centre.y) <= farthest))
            fail("an arc without a middle: it needs I or J, or R");
        if (std::abs(start - end) > std::max(0.1, 0.02 * start))
            fail(fmt::format("an arc that begins {:.4g} mm from its middle and ends {:.4g} mm from it", start, end));
        return centre;
    }

    void go_home(GcodeWords& words)
    {
        unsigned axes = 0;
        for (char letter = words.peek(); letter != '\0' && letter != '*'; letter = words.peek()) {
            const int index = word_index(letter);
            if (index >= X && index <= Z)
                axes |= 1u << index;
            words.take_letter();
            double ignored = 0;
            words.take_number(ignored);
        }
        dvec3 to = at_;
        for (int k = 0; k < 3; ++k)
            if (axes == 0 || (axes >> k & 1) != 0)
                to[k] = shift_[k] = 0;
        go(to, 0);
    }

    void set_place(GcodeWords& words, int sub)
    {
        if (sub != 0) { // G92.1: as at the start
            shift_ = dvec3(0);
            return;
        }
        MoveWords now = take_words(words);
        if ((now.given & 15u) == 0)
            now.given = 15u;
        for (int k = 0; k < 3; ++k)
            if (now.has(Word(k)))
                shift_[k] = at_[k] - now.value[k];
        if (now.has(E))
            filament_ = now.value[E];
    }

    void go(const dvec3& to, double filament)
    {
        const double length = glm::distance(at_, to);
        if (speed_ > 0)
            path_.seconds += (length > 0 ? length : std::abs(filament)) / speed_;
        if (length < 1e-6) {
            at_ = to;
            return;
        }
        if (path_.moves.empty())
            path_.start = vec3(at_);
        PrintMove move;
        move.to = vec3(to);
        move.speed = float(speed_);
        move.feature = feature_;
        move.tool = tool_;
        if (filament > 0)
            make_bead(move, to.z, length, filament);
        move.layer = std::uint32_t(std::max<std::size_t>(layers_.size(), 1) - 1);
        path_.moves.push_back(move);
        at_ = to;
    }

    void make_bead(PrintMove& move, double z, double length, double filament)
    {
        const PrintLayer& layer = layers_.place(at_.z, z, height_);
        const double height = height_ > 0 ? height_ : double(layer.height);
        const double most = std::max(10 * height, 2.0);
        const double width = width_ > 0 ? width_ : std::clamp(bead_width(filament * thread_ / length, height), 1e-3, most);
        move.width = float(width);
        move.height = float(height);
        path_.filament += filament;
        path_.volume += filament * thread_;
    }

    void take_comment(const GcodeComment& comment)
    {
        const auto length = [&] { return comment.number > 0 && comment.number < 100 ? comment.number : 0; }; // 0: not told
        switch (comment.told) {
        case GcodeTold::nothing: break;
        case GcodeTold::layer_change:
        case GcodeTold::layer_number: layers_.mark(comment.told); break;
        case GcodeTold::feature: feature_ = feature_from_slicer(comment.text); break;
        case GcodeTold::width: width_ = length(); break;
        case GcodeTold::height: height_ = length(); break;
        case GcodeTold::layer_count: layers_.announce(comment.number); break;
        case GcodeTold::volumetric: volumetric_ = true; break;
        case GcodeTold::slicer: keep_first(path_.slicer, comment.text); break;
        case GcodeTold::time: keep_first(path_.stated_time, comment.text); break;
        case GcodeTold::settings_begin: in_settings_ = true; break;
        case GcodeTold::settings_end: in_settings_ = false; break;
        }
    }

    static void keep_first(std::string& kept, std::string_view text)
    {
        if (kept.empty())
            kept = text;
    }

    void finish()
    {
        if (in_settings_)
            fail("the file ends within the slicer's settings: it is cut short");
        if (const auto missing = layers_.missing())
            fail(fmt::format("the file ends after {} of {:.0f} layers: it is cut short", missing->found, missing->announced));
        if (path_.filament <= 0)
            fail_file("no move extrudes anything");
        path_.layers = layers_.finished(path_.moves);
        if (path_.slicer.starts_with("PrusaSlicer") && !has_settings_)
            path_.notes.emplace_back("ends without the settings that PrusaSlicer writes last, so it may be cut short");
        if (layers_.assumed() > 0)
            path_.notes.push_back(fmt::format("the height of {} unknown, taken as that of the layer before or {} mm",
                                              layers_.assumed() == 1 ? "a layer is" : fmt::format("{} layers is", layers_.assumed()),
                                              usual_layer_height));
    }

    const std::string_view text_;
    const std::string& name_;
    const double arc_error_;
    PrintPath path_;

    // Modes and places, as the lines so far have set them.
    dvec3 at_ = dvec3(0), shift_ = dvec3(0); ///< the nozzle's place, and where the origin of absolute places is
    double filament_ = 0, thread_ = 0;       ///< E, and the section of a mm of it, mm²
    double unit_ = 1, speed_ = 0;
    bool relative_ = false, filament_relative_ = false, volumetric_ = false, level_arcs_ = true;
    int motion_ = -1;
    std::uint8_t tool_ = 0;
    std::vector<dvec3> arc_;

    // What comments tell.
    BeadFeature feature_ = BeadFeature::other;
    double width_ = 0, height_ = 0;
    bool in_settings_ = false, has_settings_ = false;
    GcodeLayers layers_;
};

} // namespace

PrintPath gcode_from_text(std::string_view text, const std::string& name, const GcodeOptions& options)
{
    return Machine(text, name, options).run();
}

PrintPath read_gcode(const std::filesystem::path& file, const GcodeOptions& options)
{
    if (file == "-")
        return gcode_from_text(read_file(file), "standard input", options);
    const MappedFile mapped(file);
    return gcode_from_text(mapped.bytes(), file.string(), options);
}

bool is_gcode_format(std::string_view ending) { return ending == "gcode" || ending == "gco" || ending == "g"; }

} // namespace limn
