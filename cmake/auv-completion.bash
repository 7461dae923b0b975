# bash completion of Posidonia's programs: the flags that --help lists, and files.
_auv()
{
	local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} ending=""
	if [[ $word == -* ]]; then
		mapfile -t COMPREPLY < <(compgen -W "$("$1" --help 2>/dev/null | grep -oE '(^|[ ,])--?[a-zA-Z][a-zA-Z0-9-]*' | tr -d ' ,' | sort -u)" -- "$word")
		return
	fi
	case $before in
		-c | --config) ending=ini ;;
		-r | --rawlog) ending=rawlog ;;
		-g | --ground-truth) ending=tum ;;
	esac
	compopt -o filenames
	mapfile -t COMPREPLY < <(compgen -d -- "$word"; compgen -f -X "${ending:+!*.$ending}" -- "$word")
}
complete -F _auv auv-sim auv-ekf auv-graphslam auv-mission auv-eval auv-report auv-dataset2rawlog auv-graph-optimize
