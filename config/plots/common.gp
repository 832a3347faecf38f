# What all plots share. It is loaded before each of them: gnuplot -d common.gp -c PLOT.gp DATA.csv PLOT.svg [TEXT …]
set encoding utf8
set datafile separator ","
set datafile columnheaders
# Otherwise a row that is left out would end a curve or a histogram and begin another one.
set datafile missing NaN
set terminal svg size 800,540 font "sans-serif,13" noenhanced background "white"
set minussign
set border 3 linecolor rgb "#404040"
set tics nomirror
set grid linetype 1 linecolor rgb "#e0e0e0"
set key below center Left reverse height 1.5
set style fill solid noborder
blue = "#0072b2"
orange = "#d55e00"
green = "#009e73"

# A number of a row of that kind. Where a name has a comma behind a quote, gnuplot takes it for two fields and finds
# another word in "kind": such a row is left out instead of drawn wrongly.
number(name, kind) = strcol("kind") eq kind ? column(name) : NaN
food(name) = number(name, "heightfield")
food_or_fruit(name) = strcol("kind") eq "scan" ? column(name) : food(name)

min(a, b) = a < b ? a : b
max(a, b) = a > b ? a : b
clamp(x, low, high) = x != x ? NaN : max(low, min(high, x))

# The mean of these is a share in per cent.
below(limit, x) = x != x ? NaN : x < limit ? 100.0 : 0.0

# How far an axis has to reach: to the largest absolute value, but not much beyond most others, because a few outliers
# would squeeze everything else together.
reach(least, most, mean, deviation) = min(max(-least, most), 4.0 * sqrt(mean ** 2 + deviation ** 2))

# The next of …, 1, 2, 5, 10, …: numbers that people can read.
power(x) = 10.0 ** floor(log10(x))
rounded_up(x) = power(x) * (x > 5 * power(x) ? 10 : x > 2 * power(x) ? 5 : x > power(x) ? 2 : 1)
rounded_down(x) = power(x) * (x < 2 * power(x) ? 1 : x < 5 * power(x) ? 2 : 5)

# To be evaluated where there is nothing to draw; ends the script.
reason = "nothing was measured"
no_data = 'set label 1 "No data: " . reason . "." at graph 0.5, 0.5 center; unset border; unset tics; ' . \
          'plot [0:1] [0:1] NaN notitle; exit'
