#!/bin/sh
# What each parameter of profile paper does to the result: one change at a time over a set of captures with truth.
# Usage: sensitivity.sh PROGRAM SET [SEEDS [NAME=VALUE…]]; without changes named, those listed below. Prints a Markdown row for
# each.
set -eu
program=$1
set_folder=$2
seeds=${3:-2}
shift 2
[ $# -gt 0 ] && shift

changes="
view.feature_dish_px=131072 view.feature_dish_px=262144 view.card_px_per_mm=3 view.card_px_per_mm=4.5
view.matching_dish_px=65536 view.matching_dish_px=262144 limits.max_keypoints=1500 limits.max_keypoints=5000
surf.first_step_px=2 surf.min_response=0.0002 surf.min_response=0.0004 surf.octaves=3
matcher.distinctiveness_ratio=1 matcher.distinctiveness_ratio=1.05 matcher.distinctiveness_ratio=1.15 matcher.top_ranking=2
matcher.distance_cutoff=0.25 matcher.distance_cutoff=0.5
pose.threshold=fixed pose.threshold=a_contrario pose.max_noise_fraction=0.01 pose.max_noise_fraction=0.1
pose.noise_sample=250 pose.noise_sample=4000 pose.min_inliers=8 pose.min_inliers=32 pose.min_inlier_rate=0.05 pose.min_inlier_rate=0.3
pose.local_optimisation=false pose.local_iterations=5 pose.local_iterations=50 pose.max_restarts=0 pose.refine=false
pose.robust_scale=2 pose.robust_scale=100
card.model=absolute_pose card.inlier_fraction=0.01 card.min_distance_fraction=0.1 card.min_distance_fraction=0.5
disparity_range.enlargement_px=8 disparity_range.enlargement_px=32
stereo.cost=sad stereo.cost=zncc stereo.census_radius_px=2 stereo.census_radius_px=4 stereo.window_radius_px=0 stereo.window_radius_px=2
stereo.window_radius_px=3 stereo.levels=1 stereo.levels=3 stereo.band_px=2 stereo.band_px=5 stereo.smoothness=4 stereo.smoothness=16
stereo.smoothness_deviation=2 stereo.smoothness_deviation=8 stereo.median_radius_px=0 stereo.median_radius_px=1
mesh.points=1024 mesh.points=2048 mesh.points=8192 mesh.points=16384 dish.surface=card_alone"

echo "| change | MAPE % | bias % | CV % | MAPE over the dish % | rotation deg | direction deg | scale % | refused |"
echo "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
# The last row of captures.csv is about all captures; its columns are found by their names.
measure() {
  title=$1
  shift
  "$program" evaluate "$set_folder" --runs "$seeds" --jobs "$(nproc)" --out "$folder" "$@" >/dev/null 2>&1 || :
  awk -F, -v title="$title" '
    NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i }
    $1 == "all" {
      printf "| %s", title
      split("mape_above_bottom_plane bias_above_bottom_plane cv mape rotation_deg direction_deg scale_percent refused", names, " ")
      for (i = 1; i <= 8; ++i) printf " | %s", $column[names[i]]
      print " |"
    }' "$folder/captures.csv"
}
set -- ${*:-$changes}
measure "as it is" --profile paper
for change in "$@"; do measure "$change" --profile paper --set "$change"; done
