# To be sourced: makes apt work in folder $1, with package lists of its own, so that the machine's stay as they are; nothing is
# installed. $2: lines of apt.conf beside.
apt=$1/apt
mkdir -p "$apt/lists/partial" "$apt/cache/archives/partial"
: >"$apt/status"
cat >"$apt/apt.conf" <<END
APT::Sandbox::User "root";
Dir::State "$apt";
Dir::State::status "$apt/status";
Dir::Cache "$apt/cache";
Debug::NoLocking "true";
$2
END
export APT_CONFIG=$apt/apt.conf LC_ALL=C
