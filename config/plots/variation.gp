# Repeatability, as in the paper's Fig. 8 (b). ARG1: items.csv.
set output ARG2
title = "Repeatability: coefficient of variation of each item"
set title title
stats ARG1 using (food("cv")) nooutput name "cv"
reason = "no item has two volumes to compare"
if (!exists("cv_records")) { evaluate no_data }
stats ARG1 using (below(1.5, food("cv"))) nooutput name "steady"
stats ARG1 using (below(10.0, food("cv"))) nooutput name "fair"

end = clamp(reach(0, cv_max, cv_mean, cv_stddev), 2, 30)
width = rounded_up(end / 40.0)
end = width * ceil(end / width)
bin(x) = width * (floor(clamp(x, 0, end - width / 2) / width) + 0.5)

set title sprintf("%s\n%d items: mean %.2f %%, %.1f %% of them below 1.5 %%, %.1f %% below 10 %%", \
                  title, cv_records, cv_mean, steady_mean, fair_mean)
set xlabel "coefficient of variation over pairs and seeds (%); the last bin counts what lies beyond"
set ylabel "share of the items (%)"
set xrange [0:end]
set yrange [0:*]
set boxwidth 0.92 * width
set arrow from cv_mean, graph 0 to cv_mean, graph 1 nohead front linewidth 2 linecolor rgb orange
plot ARG1 using (bin(food("cv"))):(100.0 / cv_records) smooth frequency with boxes \
       linecolor rgb blue title "food items", \
     keyentry with lines linewidth 2 linecolor rgb orange title "mean"
