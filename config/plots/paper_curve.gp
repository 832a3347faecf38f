# The mean error over a number that changes from row to row of one of the paper's tables.
# ARG1: the table's rows, ARG3: title, ARG4: what the number is.
set output ARG2
set title ARG3
stats ARG1 using (column("number")):(column("ours_mape_percent")) nooutput name "ours"
stats ARG1 using (column("number")):(column("best_mape_percent")) nooutput name "best"
if (!exists("ours_records") && !exists("best_records")) { evaluate no_data }

most = 60
share(name) = clamp(column(name), 0, most)

set xlabel ARG4
set ylabel sprintf("MAPE (%%); marks beyond %d %% stand at the edge", most)
set yrange [0:*<most]
set offsets graph 0.04, graph 0.04, 0, 0
plot ARG1 using (column("number")):(share("paper_mape_percent")) with linespoints pointtype 5 linecolor rgb orange \
       title "the paper", \
     ARG1 using (column("number")):(share("ours_mape_percent")) with linespoints pointtype 7 linecolor rgb blue \
       title "ours", \
     ARG1 using (column("number")):(share("best_mape_percent")) with linespoints pointtype 7 linecolor rgb green \
       title "profile best"
