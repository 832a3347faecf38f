# Measured against true volume. Logarithmic: the same relative error is the same distance everywhere. ARG1: pairs.csv.
set output ARG2
title = "Measured against true volume"
set title title
true_volume(ignored) = column("truth_ml") > 0 && column("estimates") > 0 ? food_or_fruit("truth_ml") : NaN
stats ARG1 using (true_volume(0)) nooutput name "truth"
if (!exists("truth_records")) { evaluate no_data }

low = 0.999 * rounded_down(truth_min / 1.15)  # or rounding might hide the numbers at the ends
high = 1.001 * rounded_up(1.15 * truth_max)
volume(x) = clamp(x, low, high)
bottom(ignored) = volume(column("mean_ml") - 2 * column("sigma_ml"))
top(ignored) = volume(column("mean_ml") + 2 * column("sigma_ml"))

set title sprintf("%s\n%d marks: an item of a pair, mean over seeds; bars: two standard deviations, where estimated", \
                  title, truth_records)
set xlabel "true volume (ml)"
set ylabel "measured volume (ml); marks beyond stand at the edge"
set logscale xy
set xtics (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000)
set ytics (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000)
set xrange [low:high]
set yrange [low:high]
plot x linecolor rgb "black" title "equal", \
     1.1 * x dashtype 2 linecolor rgb "#909090" title "±10 %", \
     0.9 * x dashtype 2 linecolor rgb "#909090" notitle, \
     ARG1 using (true_volume(0)):(bottom(0)):(0):(top(0) - bottom(0)) with vectors nohead \
       linecolor rgb "#b0b0b0" notitle, \
     ARG1 using (true_volume(0)):(volume(number("mean_ml", "heightfield"))) with points pointtype 7 pointsize 0.5 \
       linecolor rgb "#800072b2" title "foods", \
     ARG1 using (true_volume(0)):(volume(number("mean_ml", "scan"))) with points pointtype 5 pointsize 0.5 \
       linecolor rgb "#80d55e00" title "scanned fruit, closed volume"
