#!/usr/bin/env bash
# Draws the pictures of README.md and docs/ again, with the limn of build/ (and ImageMagick for the one that joins five).
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
models=$(mktemp -d)
trap 'rm -rf "$models"' EXIT

sample() { build/limn sample "$1" --triangles "$2" --quiet -o "$models/$1.ply"; }
picture() { # picture NAME MODEL OPTIONS...
    build/limn draw "$models/$2.ply" --up-axis z --quiet -o "docs/images/$1.svg" "${@:3}"
}

for shape in bumpy-torus blob knot rings; do sample "$shape" 200000; done
sample cylinder 5000

picture bumpy-torus bumpy-torus --size 1200x900 --view 20,35
picture contour blob --size 600x450 --lines contour
picture suggestive blob --size 600x450 --lines contour,suggestive
picture apparent blob --size 600x450 --lines contour,apparent
picture ridges blob --size 600x450 --lines contour,ridge,valley --style coloured
picture outline knot --size 600x450 --lines outline
picture dark blob --size 600x450 --style dark
picture toon blob --size 600x450 --style toon
picture strokes knot --size 600x450 --stroke outline
picture hidden rings --size 600x450 --lines contour --hidden dash
picture sheet cylinder --size 800x600 --lines technical --hidden dash --ortho --view front --view top --view right --view iso

render() { # render NAME MODEL OPTIONS...
    build/limn render "$models/$2.ply" --up-axis z --quiet --size 480x360 -o "docs/images/$1.png" "${@:3}"
}

render render-smooth knot
render render-toon knot --shading toon --toon-levels 3 --light 2,-3,4 --lines illustration
render render-flat cylinder --shading flat --lines technical --light 2,-3,5
render render-dark blob --style dark --surface-colour '#555555' --lines contour,suggestive,highlight
render render-ground knot --ground --lines contour --background '#dfe8f0' --light 2,-3,5
upright() { # upright NAME MODEL SIZE OPTIONS...
    build/limn render "$models/$2.ply" --quiet --size "$3" -o "docs/images/$1.png" "${@:4}"
}

upright light-sphere knot 480x360 --ground --light sphere:2,4,3,0.6
upright light-rect knot 480x360 --ground --light rect:-3,3,2,3,2
upright light-ao knot 480x360 --ground --ao --shadow-samples 256
# A blue sky with a sun in the upper left, above brown ground.
python3 - "$models/sky.hdr" <<'PYTHON'
import math, struct, sys
width, height = 256, 128
def bytes_of(rgb):
    scale, exponent = math.frexp(max(rgb))
    return bytes([int(c * scale * 256 / max(rgb)) for c in rgb] + [exponent + 128])
with open(sys.argv[1], "wb") as out:
    out.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width))
    for y in range(height):
        up = math.cos(math.pi * (y + 0.5) / height)
        for x in range(width):
            sun = math.exp(-((x - 80) ** 2 + (y - 34) ** 2) / 9)
            sky = [0.5 - 0.3 * up, 0.6 - 0.2 * up, 0.75] if up > 0 else [0.25, 0.2, 0.15]
            out.write(bytes_of([c + 150 * sun for c in sky]))
PYTHON
upright light-env knot 480x360 --ground --light "env:$models/sky.hdr" --shadow-samples 256
build/limn bench pattern --edges 16 --runs 1 --figures "$models/figures" --quiet > /dev/null
convert "$models/figures/truth.png" -resize 808x docs/images/print-truth.png
sample torus 200000
cp docs/scene.json "$models"
build/limn render "$models/scene.json" --quiet -o docs/images/scene.png
for method in width texture; do
    render "shader-lines-$method" blob --shader-lines "$method"
done
for method in threshold depth-raw depth valley valley-printed; do
    build/limn render "$models/blob.ply" --up-axis z --quiet --size 240x200 -o "$models/$method.png" --image-lines "$method" --unlit 1 --surface-colour '#ffffff'
done
montage "$models"/{threshold,depth-raw,depth,valley,valley-printed}.png -tile 5x -geometry +2+2 docs/images/image-lines.png

cage() { # cage NAME MODEL OPTIONS...
    build/limn render "$2" --up-axis z --quiet --size 400x540 --view 30,20 --lines technical -o "$models/$1.png" "${@:3}"
}

build/limn subdivide docs/pawn.obj --levels 1 --quiet -o "$models/once.obj"
build/limn subdivide docs/pawn.obj --max-error 0.001 --limit --quiet -o "$models/limit.obj"
cage level-0 docs/pawn.obj --shading flat --crease-angle 1
cage level-1 "$models/once.obj" --shading flat --crease-angle 1
cage level-limit "$models/limit.obj"
montage "$models"/level-{0,1,limit}.png -tile 3x -geometry +2+2 docs/images/subdivision.png

for shape in creature rook mug bracket leaf bent-cylinder; do
    build/limn sample "$shape" --quiet -o "$models/$shape.obj"
    build/limn subdivide "$models/$shape.obj" --levels 4 --limit --quiet -o "$models/$shape-limit.obj"
    build/limn render "$models/$shape-limit.obj" --quiet --size 320x280 --view 35,25 -o "$models/$shape.png"
done
montage "$models"/{creature,rook,mug,bracket,leaf,bent-cylinder}.png -tile 3x -geometry +2+2 docs/images/control-samples.png

fox() { # fox NAME OPTIONS...
    build/limn render "$models/creature.obj" --quiet --size 480x400 --view 40,25 -o "$models/fox-$1.png" "${@:2}"
}
fox polygons --shading flat
fox loop --subdivision loop
fox cut --subdivision loop --surface-error 0 --overlay ADE
build/limn draw "$models/creature.obj" --quiet --size 480x400 --view 40,25 -o "$models/fox-lines.png" --subdivision loop --lines contour,suggestive
montage "$models"/fox-{polygons,loop,cut,lines}.png -tile 2x -geometry +2+2 docs/images/silhouettes.png

for space in object tangent; do
    build/limn subdivide docs/pawn.obj --normal-map "$models/map-$space.png" --map-size 512 --space "$space" --quiet -o "$models/mapped.obj"
done
montage "$models"/map-{object,tangent}.png -tile 2x -geometry +2+2 docs/images/normal-map.png

if command -v blender >/dev/null; then
    build/limn subdivide "$models/mug.obj" --levels 0 --limit --quiet -o "$models/mug-0.obj"
    build/limn subdivide "$models/mug.obj" --normal-map "$models/mug-map.png" --map-size 2048 --space tangent --quiet -o "$models/mug-map.obj"
    blender -b -noaudio -P bench/peers/blender_normal_map.py -- "$models/mug-0.obj,,,$models/in-blender-0.png" \
        "$models/mug-map.obj,$models/mug-map.png,tangent,$models/in-blender-1.png" "$models/mug-limit.obj,,,$models/in-blender-2.png" >/dev/null
    montage "$models"/in-blender-{0,1,2}.png -tile 3x -geometry +2+2 docs/images/normal-map-in-blender.png
fi

build/limn sample terrain --size 513 --seed 3 --quiet -o "$models/terrain.tif"
build/limn terrain "$models/terrain.tif" --quiet --size 720x405 -o docs/images/terrain.png
build/limn terrain "$models/terrain.tif" --quiet --show lines --view 30,18 --iso 50m --size 900x420 -o docs/images/panorama.png

build/limn sample sphere --triangles 100000 --quiet -o "$models/sphere.ply"
build/limn sample cube --quiet -o "$models/cube.ply"
upright print-layers knot 480x400 --material layers --layer-height 0.8mm
upright print-cusps knot 480x400 --material layers --layer-height 0.8mm --show cusp
upright bricks cube 480x400 --material bricks --ground
upright thread sphere 480x400 --material thread --ground
build/limn sample vase --quiet -o "$models/vase.gcode"
build/limn render "$models/vase.gcode" --quiet --size 480x400 --view 20,25 --filament silk-copper -o docs/images/print-vase.png
build/limn render "$models/vase.gcode" --quiet --size 480x400 --color feature --layers ..80 --view 20,40 -o docs/images/print-feature.png
