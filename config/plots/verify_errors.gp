# The error of each scan of an acceptance test, by body. ARG1: scans.csv.
set output ARG2
title = "Errors by body, with two standard deviations of each scan"
set title title
scan(name) = column("is_repeat") == 0 ? column(name) : NaN
stats ARG1 using (scan("signed_error_percent")) nooutput name "error"
reason = "nothing was measured"
if (!exists("error_records")) { evaluate no_data }

end = ceil(clamp(reach(error_min, error_max, error_mean, error_stddev), 5, 50))
set title sprintf("%s\n%d scans without repeats, mean %+.2f %%", title, error_records, error_mean)
set xlabel "body"
set ylabel "signed error (%); dots beyond stand at the edge"
set yrange [-end:end]
set xzeroaxis linetype 1 linecolor rgb "#404040"
set offsets 0.5, 0.5, 0, 0
# Side by side in the order of the scans.
place(ignored) = column("body_number") + 0.06 * (column(0) - 6 * floor(column(0) / 6) - 2.5)
plot ARG1 using (place(0)):(clamp(scan("signed_error_percent"), -end, end)):(2 * column("sigma_percent")) \
       with yerrorbars pointtype 7 pointsize 0.5 linecolor rgb blue title "a scan", \
     ARG1 using (column("body_number")):(scan("signed_error_percent")):xticlabels(2) smooth unique with points \
       pointtype 5 pointsize 0.9 linecolor rgb orange title "mean of a body"
