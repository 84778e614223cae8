#!/usr/bin/env python3
"""Times Blender's Line Art and Freestyle (Debian package blender, 3.4) beside limn on one mesh and camera.

usage: blender_lines.py LIMN FOLDER [--triangles N] [--into FILE]

Writes the mesh, the pictures (SVG) and limn's drawings to FOLDER and prints a markdown table with ratios; with --into it also
replaces the section between the marks "begin peers" and "end peers" of FILE (docs/benchmarks.md), and nothing else in it.
"""
import argparse
import json
import os
import subprocess
import sys
import time
from statistics import mean, median

HERE = os.path.dirname(os.path.abspath(__file__))
TURNS = 5
RUNS = 3


def run(*command):
    start = time.perf_counter()
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    return done.stdout, time.perf_counter() - start


def draw(limn, mesh, folder, lines, name):
    """First view and further views of limn: seconds by stage, and the camera of the first view."""
    common = [limn, 'draw', mesh, '--lines', lines, '--size', '1024x1024', '--json', '--quiet']
    per_view = lambda seconds: seconds['extract'] + seconds['visibility'] + seconds['chain']
    # From the mesh in memory: everything but reading and writing.
    in_memory = lambda seconds: sum(seconds[key] for key in ('surface', 'merge', 'rays', 'features')) + per_view(seconds)
    runs = [run(*common, '-o', f'{folder}/{name}.svg') for _ in range(RUNS)]
    report = json.loads(runs[0][0])
    first = median(in_memory(json.loads(out)['seconds']) for out, _ in runs)
    turn = json.loads(run(*common, '--turntable', str(TURNS), '-o', f'{folder}/{name}-turn.svg')[0])
    further = median(per_view(view['seconds']) for view in turn['views'][1:])
    strokes = sum(kind['strokes'] for kind in report['views'][0]['types'].values())
    return {'first': first, 'further': further, 'process': median(process for _, process in runs), 'strokes': strokes,
            'camera': report['views'][0]['camera']}


def blender(mesh, camera, folder, what):
    out, process = run('blender', '-b', '-noaudio', '-P', f'{HERE}/in_blender.py', '--', mesh, camera, folder, what)
    line = next(line for line in out.splitlines() if line.startswith('PEER '))
    result = json.loads(line[5:])
    result['process'] = process
    return result


def row(name, first, further, process, strokes=''):
    return f'| {name} | {first:.2f} | {further:.3f} | {process:.2f} | {strokes} |'


def ratios(name, peer, ours):
    return f"| {name} / limn | {peer[0] / ours['first']:.1f} x | {peer[1] / ours['further']:.0f} x | {peer[2] / ours['process']:.1f} x | |"


def markdown(triangles, contours, suggestive, line_art, art_strokes, freestyle):
    return '\n'.join([
        '## Beside Blender', '',
        f'`bench/peers/blender_lines.py`: Blender 3.4 of Debian 12 and limn on one mesh (`limn sample blob`, {triangles:,} triangles, as OBJ) and one',
        f'camera, 1024 x 1024, {os.cpu_count()} processors. Seconds; limn: medians of {RUNS} runs; Blender: one run. *First view*: from the mesh in memory, for',
        'limn with surface, ray scene and curvature; *process*: from the file to the picture. Line Art is the whole evaluation of the',
        'modifier, contours only. Freestyle is a render with lines minus one without; its process leaves out the start of Blender.',
        'Pictures and what each does better: [beside-blender.md](beside-blender.md).', '',
        '| | first view | further views | process | strokes |',
        '|---|---:|---:|---:|---:|',
        row('limn, contours', contours['first'], contours['further'], contours['process'], contours['strokes']),
        row('Line Art, contours', *line_art, art_strokes),
        ratios('Line Art', line_art, contours),
        row('Freestyle, contours', *freestyle['freestyle']),
        ratios('Freestyle', freestyle['freestyle'], contours),
        row('limn, contours and suggestive contours', suggestive['first'], suggestive['further'], suggestive['process'], suggestive['strokes']),
        row('Freestyle, the same', *freestyle['freestyle-suggestive']),
        ratios('Freestyle', freestyle['freestyle-suggestive'], suggestive), ''])


def replace_section(path, text):
    with open(path) as file:
        old = file.read()
    begin, end = '<!-- begin peers -->\n', '<!-- end peers -->'
    before, rest = old.split(begin)
    with open(path, 'w') as file:
        file.write(before + begin + text + '\n' + end + rest.split(end)[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('limn')
    parser.add_argument('folder')
    parser.add_argument('--triangles', default='1000000')
    parser.add_argument('--into')
    asked = parser.parse_args()
    limn, folder = asked.limn, asked.folder
    os.makedirs(folder, exist_ok=True)
    mesh = f'{folder}/blob.obj'
    run(limn, 'sample', 'blob', '--triangles', asked.triangles, '-o', mesh, '--quiet')
    contours = draw(limn, mesh, folder, 'contour', 'limn-contours')
    suggestive = draw(limn, mesh, folder, 'contour,suggestive', 'limn-suggestive')
    camera = f'{folder}/camera.json'
    with open(camera, 'w') as file:
        json.dump(contours['camera'], file)
    art = blender(mesh, camera, folder, 'lineart')
    style = blender(mesh, camera, folder, 'freestyle')
    line_art = (art['lineart']['first'], mean(art['lineart']['further']), art['process'] - sum(art['lineart']['further']))
    # One process of Blender draws four views with and without lines: half of it is what one drawing of each kind takes.
    freestyle = {name: (style['freestyle'][name]['first'], mean(style['freestyle'][name]['further']),
                        style['read'] + style['freestyle'][name]['first'] + style['freestyle'][name]['without_lines'][0])
                 for name in ('freestyle', 'freestyle-suggestive')}
    text = markdown(art['triangles'], contours, suggestive, line_art, art['lineart']['strokes'], freestyle)
    print(text)
    if asked.into:
        replace_section(asked.into, text)


main()
