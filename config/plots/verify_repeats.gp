# The repeats of an acceptance test in their order. ARG1: scans.csv.
set output ARG2
title = "Repeats: one body, lifted and laid again"
set title title
repeated(name) = column("is_repeat") == 1 ? column(name) : NaN
stats ARG1 using (repeated("volume_ml")) nooutput name "volume"
reason = "no repeat was measured"
if (!exists("volume_records")) { evaluate no_data }
stats ARG1 using (repeated("body_ml")) nooutput name "body"

# n - 1: as the certificate has it.
deviation = volume_records > 1 ? volume_stddev * sqrt(volume_records / (volume_records - 1.0)) : 0
set title sprintf("%s\n%d repeats: mean %.1f ml, coefficient of variation %.2f %%", title, volume_records, \
                  volume_mean, 100 * deviation / volume_mean)
set xlabel "repeat"
set ylabel "volume (ml)"
count = 0
number(name) = repeated(name) == repeated(name) ? (count = count + 1, count) : NaN
set xrange [0.5:volume_records + 0.5]
set yrange [*:*]
set offsets 0, 0, graph 0.1, graph 0.1
plot ARG1 using (number("volume_ml")):(repeated("volume_ml")):(2 * column("sigma_ml")) with yerrorbars pointtype 7 \
       pointsize 0.5 linecolor rgb blue title "a repeat, with two standard deviations", \
     body_mean with lines linewidth 2 linecolor rgb orange title "the body's volume"
