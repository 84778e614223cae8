# shellcheck shell=bash disable=SC2034
# Sourced by ./demo and ./test: what Limn needs from the system, and how it is installed and built.

build_packages=(
    g++ cmake ninja-build pkg-config ccache mold
    libglm-dev libeigen3-dev libtbb-dev libembree-dev libassimp-dev libcairo2-dev libpng-dev
    libfmt-dev libcli11-dev nlohmann-json3-dev libhwy-dev libgtest-dev
    zlib1g-dev libzstd-dev libopenexr-dev libgdal-dev libproj-dev libepoxy-dev libegl-dev libegl-mesa0 libgl1-mesa-dri
    libglfw3-dev libimgui-dev
)
test_packages=(
    librsvg2-bin  # rasterises Limn's SVG files, to compare them with its PNG files
    poppler-utils # and its PDF files
    glslang-tools # compiles the formulas as GLSL
    libosd-dev    # subdivides too, independently
    xvfb          # a display for windows to be tested on
)
model_packages=(glmark2-data)  # the Stanford bunny

say() { printf '%s\n' "$*" >&2; }

# Prints those of the named packages that are not installed.
missing_packages() {
    local installed package
    installed=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "$@" 2>/dev/null || true)
    for package in "$@"; do
        grep -qx "installed $package" <<<"$installed" || printf '%s ' "$package"
    done
}

# Runs apt-get without questions, with sudo where that is needed.
apt_get() {
    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || return 1
        as_root=(sudo)
        [ -t 0 ] || as_root=(sudo -n) # nobody there to type a password
    fi
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=120 "$@"
}

# Installs those of the named packages that are missing; false when that cannot be done.
install_packages() {
    local missing
    command -v dpkg-query >/dev/null || { say "This is not Debian; Limn needs what these packages hold: $*"; return 0; }
    missing=$(missing_packages "$@")
    [ -n "$missing" ] || return 0
    say "Installing: $missing"
    # A fresh machine has no package lists yet, and an old one may have stale ones: then fetch them and try again.
    # shellcheck disable=SC2086
    { apt_get install -y --no-install-recommends $missing || { apt_get update && apt_get install -y --no-install-recommends $missing; }; } >&2 && return 0
    say "These packages could not be installed. As root, run:"
    say "  apt-get update && apt-get install -y --no-install-recommends $missing"
    return 1
}

# Configures and builds a preset of CMakePresets.json; more arguments go to the build (--target limn_app).
build_preset() {
    local preset=$1
    shift
    cmake --preset "$preset" --log-level=WARNING >&2
    cmake --build --preset "$preset" --parallel "$(nproc)" "$@" >&2
}
