# The distribution of the errors, as in the paper's Fig. 8 (a). ARG1: estimates.csv.
set output ARG2
title = "Signed error of the volumes"
set title title
stats ARG1 using (food("signed_error_percent")) nooutput name "error"
if (!exists("error_records")) { evaluate no_data }
stats ARG1 using (below(10.0001, abs(food("signed_error_percent")))) nooutput name "within"

end = clamp(reach(error_min, error_max, error_mean, error_stddev), 5, 50)
width = rounded_up(end / 20.0)
end = width * ceil(end / width)
bin(x) = width * (floor(clamp(x, -end, end - width / 2) / width) + 0.5)

set title sprintf("%s\n%d volumes: bias %+.2f %%, %.1f %% within ±10 %%", \
                  title, error_records, error_mean, within_mean)
set xlabel "signed error (%); the bins at the ends count what lies beyond"
set ylabel "share of the volumes (%)"
set xrange [-end:end]
set yrange [0:*]
set boxwidth 0.92 * width
set arrow from error_mean, graph 0 to error_mean, graph 1 nohead front linewidth 2 linecolor rgb orange
plot ARG1 using (bin(food("signed_error_percent"))):(100.0 / error_records) smooth frequency with boxes \
       linecolor rgb blue title "volumes of foods", \
     keyentry with lines linewidth 2 linecolor rgb orange title "bias"
