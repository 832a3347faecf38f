# How the error depends on the angle between the two views. ARG1: pairs.csv.
set output ARG2
title = "Error against the relative angle between the views"
set title title
stats ARG1 using (food("signed_error_percent")) nooutput name "error"
if (!exists("error_records")) { evaluate no_data }

end = ceil(clamp(reach(error_min, error_max, error_mean, error_stddev), 5, 50))
bin(x) = 5 * floor(x / 5 + 0.5)

set title sprintf("%s\n%d dots: a food of a pair, mean over seeds; lines: means over bins of 5 degrees", \
                  title, error_records)
set xlabel "relative angle (degrees)"
set ylabel "signed error (%); dots beyond stand at the edge"
set xrange [0:*]
set yrange [-end:end]
set xzeroaxis linetype 1 linecolor rgb "#404040"
plot ARG1 using (column("angle_deg")):(clamp(food("signed_error_percent"), -end, end)) with points pointtype 7 \
       pointsize 0.5 linecolor rgb "#800072b2" title "signed error", \
     ARG1 using (bin(column("angle_deg"))):(abs(food("signed_error_percent"))) smooth unique with linespoints \
       pointtype 5 pointsize 0.6 linewidth 2 linecolor rgb orange title "mean absolute error", \
     ARG1 using (bin(column("angle_deg"))):(food("signed_error_percent")) smooth unique with linespoints \
       pointtype 7 pointsize 0.4 dashtype 2 linewidth 2 linecolor rgb "black" title "mean signed error"
