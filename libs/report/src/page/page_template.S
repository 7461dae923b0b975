// The page that web/ builds, as bytes of the library: reports need no file beside the program.
	.section .rodata
	.global posidonia_report_template
	.global posidonia_report_template_end
posidonia_report_template:
	.incbin POSIDONIA_REPORT_TEMPLATE
posidonia_report_template_end:
	.byte 0
	.section .note.GNU-stack,"",%progbits
