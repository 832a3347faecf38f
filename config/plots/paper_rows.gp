# The mean error of each row of one of the paper's tables, from top to bottom.
# ARG1: the table's rows, ARG3: title.
set output ARG2
set title ARG3
stats ARG1 using (column("ours_mape_percent")) nooutput name "ours"
stats ARG1 using (column("best_mape_percent")) nooutput name "best"
if (!exists("ours_records") && !exists("best_records")) { evaluate no_data }

most = 60
share(name) = clamp(column(name), 0, most)

set xlabel sprintf("MAPE (%%); marks beyond %d %% stand at the edge", most)
set xrange [0:*<most]
set yrange [*:*] reverse
set offsets 0, 0, 0.5, 0.5
# Column 1, "title": of a column called by its name, gnuplot takes the text only up to a comma.
plot ARG1 using (share("paper_mape_percent")):(column("number")):yticlabels(1) with points pointtype 5 \
       linecolor rgb orange title "the paper", \
     ARG1 using (share("ours_mape_percent")):(column("number")):yticlabels(1) with points pointtype 7 \
       linecolor rgb blue title "ours", \
     ARG1 using (share("best_mape_percent")):(column("number")):yticlabels(1) with points pointtype 7 \
       linecolor rgb green title "profile best"
