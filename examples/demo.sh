#!/bin/sh
# demo.sh SURFMINK DIRECTORY: three real inputs and an image, measured by the command; what to look for is printed
# beside the numbers. The pictures go to DIRECTORY; outlines, patic and image/rasterise stand beside SURFMINK.
surfmink=$1 build=$(dirname "$1") pictures=$2 data=$(dirname "$0")/data
mkdir -p "$pictures" || exit 1
table=$(mktemp) flat=$(mktemp) image=$(mktemp -d)
trap 'rm -rf "$table" "$flat" "$image"' EXIT

# A column of a table by its name: the awk programs below find mu_2 and the rest wherever they stand.
columns='BEGIN { FS = OFS = "\t" } FNR == 1 { for (i = 1; i <= NF; i++) at[$i] = i }'

echo "1. The H3 grid: 5882 cells cover the sphere. Which are the pentagons?"
"$surfmink" --svg "$pictures/h3.svg" --color-by mu_5 --view 10,50 "$data/h3_res2.tsv" > "$table" || exit 1
"$surfmink" --histogram "$pictures/h3_mu.svg" --histogram-of mu_5,mu_6 --title "H3 grid: 12 pentagons, 5870 hexagons" \
    "$data/h3_res2.tsv" > "$table" || exit 1
awk "$columns"'
    FNR > 1 && $at["mu_5"] > 0.999999 { pentagons++; corners += $at["n"]; names = names "\n     " $at["id"] }
    FNR > 1 { area += $at["area"] }
    END { printf "   mu_5 = 1 in %d cells; they have %d corners each:%s\n", pentagons, corners / pentagons, names
          printf "   all cells together: %.12f (4 pi = 12.566370614359)\n\n", area }' "$table"

echo "2. Countries: which outline is the roundest, which the most elongated?"
"$surfmink" --svg "$pictures/countries.svg" --color-by mu_2 --view 20,25 --view -85,15 --radius 6371 --unit km \
    --title "How elongated are countries?" "$data/countries.tsv" > "$table"
awk "$columns"'
    FNR > 1 && $at["status"] == "ok" {
        if (lowest == "" || $at["mu_2"] < low) { low = $at["mu_2"]; lowest = $at["id"] }
        if ($at["mu_2"] > high) { high = $at["mu_2"]; highest = $at["id"] } }
    END { printf "   least elongated: %s, mu_2 = %.3f\n", lowest, low
          printf "   most elongated:  %s, mu_2 = %.3f\n", highest, high }' "$table"
echo "   (Sudan is refused: the data draw a small loop into its border, where two edges cross. The others do not mind.)"
echo

echo "3. A curved tissue: does a cell look elongated because it is, or because it is tilted?"
"$surfmink" --svg "$pictures/tissue.svg" --color-by mu_6 --view 0,0,1 --unit µm "$data/tissue.tsv" > "$table" || exit 1
"$surfmink" --svg "$pictures/tissue_ranks.svg" --color-by mu_2,mu_4,mu_5,mu_6 --unit µm \
    --histogram "$pictures/tissue_mu.svg" --histogram-of mu_2,mu_4,mu_5,mu_6 \
    --ply "$pictures/tissue.ply" "$data/tissue.tsv" > "$flat" || exit 1
"$surfmink" --scatter "$pictures/tissue_scatter.svg" --title "Elongated and hexagonal?" "$data/tissue.tsv" > "$flat"
# What a microscope sees from above: x and y of the cells whose normals point up. (Those that fold over at the rim are
# refused.)
"$surfmink" --quiet --surface plane "$data/tissue.tsv" > "$flat"
awk "$columns"'
    FILENAME == ARGV[1] { if (/^#/ || $1 == "cell") next; up[$1] += $7; corners[$1]++; next }
    $at["status"] != "ok" { next }
    FILENAME == ARGV[2] { surface[$at["id"]] = $at["mu_2"]; next }
    ($at["id"] in surface) && up[$at["id"]] > 0 {
        tilt = up[$at["id"]] / corners[$at["id"]]
        bin = tilt > 0.9 ? 1 : tilt > 0.7 ? 2 : tilt > 0.5 ? 3 : tilt > 0.3 ? 4 : 5
        print bin, surface[$at["id"]], $at["mu_2"] }' "$data/tissue.tsv" "$table" "$flat" |
    sort -n -k1,1 | awk '
    function median(v, n,    i, j, t) {
        for (i = 2; i <= n; i++)
            for (j = i; j > 1 && v[j - 1] > v[j]; j--) { t = v[j]; v[j] = v[j - 1]; v[j - 1] = t }
        return n % 2 ? v[(n + 1) / 2] : (v[n / 2] + v[n / 2 + 1]) / 2 }
    function show() { printf "   %-16s %5d %12.3f %12.3f\n", name[bin], n, median(s, n), median(f, n); n = 0 }
    BEGIN { split("0.9 to 1, flat;0.7 to 0.9;0.5 to 0.7;0.3 to 0.5;below 0.3, steep", name, ";")
            print "   median mu_2 by the cosine of the tilt:"
            printf "   %-16s %5s %12s %12s\n", "", "cells", "on surface", "projected" }
    $1 != bin && n { show() }
    { bin = $1; s[++n] = $2; f[n] = $3 }
    END { show() }'
echo

echo "4. An image: 400 cells on an ellipsoid, rasterised into a chart. Are they found as they are?"
"$build/image/rasterise" ellipsoid 20 "$image" || exit 1
"$surfmink" "$image/exact.tsv" > "$table" || exit 1
printf "   %-34s %5s %9s %9s %9s %9s\n" "" cells "rms mu_2" "rms mu_4" "rms mu_6" "bias mu_6"
# recipe NAME POINTS PASSES: against the exact cells in $table
recipe() {
    "$build/outlines" "$image/labels.npy" --positions "$image/positions.npy" --normals "$image/normals.npy" --wrap x \
        --points "$2" 2> "$image/said" | "$surfmink" --smooth "$3" > "$flat"
    awk -v name="$1" "$columns"'
        FNR == 1 { ++file; next }
        file == 1 { for (p = 2; p <= 6; p += 2) mu[$1, p] = $at["mu_" p]; next }
        $at["status"] == "ok" {
            n++
            for (p = 2; p <= 6; p += 2) { d = $at["mu_" p] - mu[$1, p]; s[p] += d * d; b[p] += d } }
        END { printf "   %-34s %5d %9.3f %9.3f %9.3f %+9.3f\n", name, n, sqrt(s[2] / n), sqrt(s[4] / n), sqrt(s[6] / n),
                     b[6] / n }' "$table" "$flat"
}
recipe "pixels, 1 pass of smoothing" pixels 1
recipe "pixels, 8 passes" pixels 8
recipe "straight lines between junctions" junctions 0
recipe "curves between junctions" curve 0
echo
echo "5. The field of a tissue: do its topological charges add up to 2, as on every sphere?"
"$build/patic" --rank 6 --defects "$flat" --svg "$pictures/field_h3.svg" --title "H3 grid, p = 6" --view 10,50 \
    "$data/h3_res2.tsv" > "$table" || exit 1
awk "$columns"'
    FNR > 1 { sum += $at["charge"]; charge[$at["charge"]]++
              split($at["cells"], cell, ","); names = names "\n     " cell[1] }
    END { for (c in charge) printf "   H3, p = 6: %d defects of charge %.4f", charge[c], c
          printf ", sum %.12g, at the cells:%s\n", sum, names }' "$flat"
for p in 2 4 6; do
    "$build/patic" --rank $p --radius 1.5c --defects "$flat" --svg "$pictures/field_tissue$p.svg" \
        --title "Tissue, p = $p, R = 1.5 cells" "$data/tissue.tsv" > "$table" || exit 1
    awk "$columns"' FNR > 1 { sum += $at["charge"]; if ($at["charge"] > 0) plus++; else minus++ }
        END { printf "   tissue, p = %d: %d positive and %d negative defects, sum %.12g\n", '$p', plus, minus, sum
        }' "$flat"
done
echo
echo "pictures: $pictures/h3.svg h3_mu.svg countries.svg tissue.svg tissue_ranks.svg tissue_mu.svg tissue_scatter.svg"
echo "          field_h3.svg field_tissue2.svg field_tissue4.svg field_tissue6.svg"
echo "polygons in space, for ParaView, MeshLab or Blender: $pictures/tissue.ply"
